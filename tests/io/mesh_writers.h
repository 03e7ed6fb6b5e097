// Writes one mesh in every readable format, for tests. Vertices should be 32-bit numbers, which all
// formats store exactly.
#pragma once
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <bit>
#include <string>
#include <vector>

#include "clench/geometry/mesh/mesh.h"

namespace clench::test {

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

/// its vertices rounded to 32 bits
inline Mesh in_32_bits(Mesh mesh) {
  for (auto& p : mesh.vertices)
    for (double& x : p) {
      // g++ 12 omits the rounding if it vectorizes this loop
      const volatile float rounded = static_cast<float>(x);
      x = rounded;
    }
  return mesh;
}

template <class T>
void append_bytes(std::string& out, T value, bool big_endian = false) {
  const auto* raw = reinterpret_cast<const char*>(&value);
  std::string bytes(raw, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big))
    bytes.assign(bytes.rbegin(), bytes.rend());
  out += bytes;
}

inline std::string obj_text(const Mesh& mesh) {
  std::string out;
  for (const auto& p : mesh.vertices) out += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : mesh.triangles)
    out += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return out;
}

inline std::string off_text(const Mesh& mesh) {
  std::string out = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const auto& p : mesh.vertices) out += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : mesh.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return out;
}

inline std::string ascii_stl(const Mesh& mesh) {
  std::string out = "solid a mesh\n";
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    out += "facet normal nan nan nan\n outer loop\n";
    for (const auto& p : mesh.corners(static_cast<int>(i)))
      out += fmt::format("  vertex {} {} {}\n", p.x(), p.y(), p.z());
    out += " endloop\nendfacet\n";
  }
  return out + "endsolid a mesh\n";
}

inline std::string binary_stl(const Mesh& mesh, const std::string& header = "") {
  std::string out = header;
  out.resize(80, ' ');
  append_bytes(out, static_cast<uint32_t>(mesh.triangles.size()));
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) append_bytes(out, 0.0f);
    for (const auto& p : mesh.corners(static_cast<int>(i)))
      for (const double x : p) append_bytes(out, static_cast<float>(x));
    append_bytes(out, uint16_t{0});
  }
  return out;
}

inline std::string ply_header(const Mesh& mesh, const std::string& format) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment a mesh\nelement vertex {}\nproperty float x\nproperty double y\n"
      "property float nx\nproperty float z\nelement face {}\nproperty uchar flags\n"
      "property list uchar int vertex_indices\nend_header\n",
      format, mesh.vertices.size(), mesh.triangles.size());
}

inline std::string ascii_ply(const Mesh& mesh) {
  std::string out = ply_header(mesh, "ascii");
  for (const auto& p : mesh.vertices) out += fmt::format("{} {} nan {}\n", p.x(), p.y(), p.z());
  for (const auto& t : mesh.triangles) out += fmt::format("7 3 {} {} {}\n", t[0], t[1], t[2]);
  return out;
}

inline std::string binary_ply(const Mesh& mesh, bool big_endian) {
  std::string out = ply_header(mesh, big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const auto& p : mesh.vertices) {
    append_bytes(out, static_cast<float>(p.x()), big_endian);
    append_bytes(out, p.y(), big_endian);
    append_bytes(out, 0.0f, big_endian);
    append_bytes(out, static_cast<float>(p.z()), big_endian);
  }
  for (const auto& t : mesh.triangles) {
    out += {'\7', '\3'};
    for (const int v : t) append_bytes(out, int32_t{v}, big_endian);
  }
  return out;
}

/// Positions with y up, then indices.
inline std::string gltf_buffer(const Mesh& mesh) {
  std::string out;
  for (const auto& p : mesh.vertices)
    for (const double x : {p.x(), p.z(), -p.y()}) append_bytes(out, static_cast<float>(x));
  for (const auto& t : mesh.triangles)
    for (const int v : t) append_bytes(out, static_cast<uint32_t>(v));
  return out;
}

/// `buffer`: its uri; `node`: further members of the node
inline std::string gltf_text(const Mesh& mesh, const std::string& uri,
                             const std::string& node = "") {
  const size_t points = 12 * mesh.vertices.size(), indices = 12 * mesh.triangles.size();
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
 "nodes": [{{"children": [1]}}, {{"mesh": 0{}}}],
 "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "material": 0}}]}}],
 "materials": [{{"pbrMetallicRoughness": {{"baseColorFactor": [1, 0.5, 0, 1]}}}}],
 "buffers": [{{{}"byteLength": {}}}],
 "bufferViews": [{{"buffer": 0, "byteLength": {}}}, {{"buffer": 0, "byteOffset": {}, "byteLength": {}}}],
 "accessors": [{{"bufferView": 0, "componentType": 5126, "count": {}, "type": "VEC3"}},
  {{"bufferView": 1, "componentType": 5125, "count": {}, "type": "SCALAR"}}]}})",
      node, uri.empty() ? "" : fmt::format("\"uri\": \"{}\", ", uri), points + indices, points,
      points, indices, mesh.vertices.size(), 3 * mesh.triangles.size());
}

inline std::string base64(const std::string& bytes) {
  static constexpr char letters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
  }
  return out;
}

inline std::string glb(const Mesh& mesh) {
  std::string text = gltf_text(mesh, ""), buffer = gltf_buffer(mesh);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string out = "glTF";
  append_bytes(out, uint32_t{2});
  append_bytes(out, static_cast<uint32_t>(28 + text.size() + buffer.size()));
  append_bytes(out, static_cast<uint32_t>(text.size()));
  out += "JSON" + text;
  append_bytes(out, static_cast<uint32_t>(buffer.size()));
  return out + std::string("BIN\0", 4) + buffer;
}

/// Meters, z up. `node`: its transformations
inline std::string collada_text(
    const Mesh& mesh, const std::string& node = "",
    const std::string& asset = "<unit meter=\"1\"/><up_axis>Z_UP</up_axis>") {
  std::string points, corners;
  for (const auto& p : mesh.vertices) points += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : mesh.triangles)
    for (const int v : t) corners += fmt::format("{} 0 ", v);
  return fmt::format(
      R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>{}</asset>
<library_effects><effect id="paint"><profile_COMMON><technique sid="common"><lambert><diffuse><color>1 0.5 0 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="orange"><instance_effect url="#paint"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="{}">{}</float_array><technique_common><accessor source="#pa" count="{}" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor></technique_common></source>
<source id="n"><float_array id="na" count="3">0 0 1</float_array></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{}" material="m"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#n" offset="1"/><p>{}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node>{}<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" target="#orange"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)",
      asset, 3 * mesh.vertices.size(), points, mesh.vertices.size(), mesh.triangles.size(), corners,
      node);
}

struct MeshFile {
  std::string name, content;
};

/// the same mesh in all formats
inline std::vector<MeshFile> in_every_format(const Mesh& mesh) {
  return {{"a.obj", obj_text(mesh)},
          {"a.off", off_text(mesh)},
          {"ascii.stl", ascii_stl(mesh)},
          {"binary.stl", binary_stl(mesh)},
          {"solid.stl", binary_stl(mesh, "solid, as some programs begin")},
          {"ascii.ply", ascii_ply(mesh)},
          {"little.ply", binary_ply(mesh, false)},
          {"big.ply", binary_ply(mesh, true)},
          {"a.gltf",
           gltf_text(mesh, "data:application/octet-stream;base64," + base64(gltf_buffer(mesh)))},
          {"a.glb", glb(mesh)},
          {"a.dae", collada_text(mesh)}};
}

}  // namespace clench::test
