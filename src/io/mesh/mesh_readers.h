// Readers of mesh files, one per format: each adds the triangles of a file to a builder, in the
// file's unit and with its up axis, and returns true if colors come from the file.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// glTF 2.0, .gltf with its buffers, and .glb: triangles of all meshes of the file's scene,
/// transformed by its nodes; in meters, y up. Skins, morph targets and animations are not used,
/// with a warning.
/// throws  Error  "part.glb: accessors[3]: expected 36 bytes of bufferViews[1], got 24"
bool read_gltf(const MeshInput& input, GeometryBuilder& builder);

/// COLLADA (.dae), versions 1.4 and 1.5: polygons of all geometries of the file's scene,
/// transformed by its nodes. Skins and morphs are not used, with a warning.
/// throws  Error  "part.dae:31: ..."
bool read_collada(const MeshInput& input, GeometryBuilder& builder);

/// Wavefront OBJ, and colors and textures from MTL files: faces over the file's vertices; of a
/// texture (`map_Kd`, PNG or JPEG) also the mean colors. Normals are not read.
/// throws  Error  "part.obj:31: expected one of 8 points after f, got 9"
bool read_obj(const MeshInput& input, GeometryBuilder& builder);

/// OFF as defined by Geomview, OFF, COFF, NOFF, STOFF and combinations of these: faces over the
/// file's vertices. Texture coordinates and normals are not read.
/// throws  Error  "part.off:31: expected 3 vertices from 0 to 8, got '9'"
bool read_off(const MeshInput& input, GeometryBuilder& builder);

/// PLY, ascii, and binary of both byte orders: faces and triangle strips over the file's vertices.
/// Other elements are skipped, with a warning; so are properties other than coordinates, colors and
/// indices.
/// throws  Error  "part.ply:31: ..." in header and ascii files, otherwise "part.ply: face 7 of 12:
///         ..."
bool read_ply(const MeshInput& input, GeometryBuilder& builder);

/// STL, ascii and binary: the facets. Normals are not read: the order of the corners determines the
/// outside.
/// throws  Error  "part.stl:31: expected 'vertex', got 'vertx'"  "part.stl: facet 12 of 99: ..."
bool read_stl(const MeshInput& input, GeometryBuilder& builder);

}  // namespace clench
