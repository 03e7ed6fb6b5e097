// Bodies and robots that a script names by file or makes from tables.
#pragma once
#include "clench/io/read/read.h"
#include "clench/script/lua/table.h"

namespace clench {

/// throws  Error "subject: expected a folder, got 'name'"
std::filesystem::path check_folder(const std::string& name, const std::string& subject);
/// The folder that limits the files read by a call: its option confine, or else that of its state;
/// empty: no limit.
std::filesystem::path read_confine(lua_State* L, Table& options);
/// Options of argument i of a call that looks at a path only: confine, and the folder of the
/// installed models. Rejects any other key.
ReadOptions read_places(lua_State* L, int i);
/// Reading options in a call's table: root; confine; unit, by its name, or mesh_scale. Warnings and
/// notes go to the script's log.
ReadOptions read_options(lua_State* L, Table& options);

/// A body from argument i: a file name, or a mesh in meters, indices from 1, {vertices = {{x, y,
/// z}, ...}, triangles = {{i, j, k}, ...}}; the keys name, material, mass or density, com,
/// elastic_modulus, soft_layer, poisson_ratio, color and transparency of the options override it.
/// throws  Error that names the invalid value
BodySpec check_body_spec(lua_State* L, int i, Table& options, const ReadOptions& reading);

/// The keys folder, eigengrasps, virtual_contacts, package, close and approach of a call's options.
/// throws  Error that names the key and the fault
void read_robot_options(lua_State* L, Table& options, ReadOptions& reading);

}  // namespace clench
