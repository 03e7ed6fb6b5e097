#include "clench/script/bind/read_mesh_table.h"

#include <cmath>

#include "clench/base/convert.h"
#include "clench/base/error.h"
#include "clench/geometry/round/recognize.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/setting.h"
#include "clench/script/lua/table.h"
#include "clench/spec/valid.h"

namespace clench {

void MeshTable::scale(double factor) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= factor;
  for (RoundPiece& piece : rounds.pieces) {
    piece.solid.radii *= factor;
    piece.solid.half *= factor;
    piece.X_SR.position *= factor;
  }
}

static RoundPiece read_round(lua_State* L, int i, const std::string& subject) {
  Table table(L, i, subject);
  RoundPiece out;
  out.solid.kind = table.choice<Round::Kind>(
      "kind",
      {{"capsule", Round::capsule}, {"cylinder", Round::cylinder}, {"ellipsoid", Round::ellipsoid}},
      Round::capsule);
  out.solid.radii = table.vec3("radii");
  out.solid.half = table.number("half", 0);
  out.X_SR = table.pose("pose", {});
  out.first = table.integer("first") - 1;
  out.count = table.integer("count");
  table.done();
  return out;
}

// Checks that each solid is valid, that its triangles lie on it, and that solids are in the order
// of their triangles.
static void check_rounds(const MeshTable& table, const std::string& subject) {
  int next = 0, number = 0;
  for (const RoundPiece& piece : table.rounds.pieces) {
    ++number;
    const Round& solid = piece.solid;
    const bool three = solid.kind == Round::ellipsoid;
    if (!(solid.radii.x() > 0 && solid.half >= 0) || (three && !(solid.radii.minCoeff() > 0)))
      fail("{}: round solid {}: expected radii > 0 and half >= 0", subject, number);
    const int count = static_cast<int>(table.mesh.triangles.size());
    if (piece.first < next || piece.count < 1 || piece.count > count - piece.first)
      fail("{}: round solid {}: expected triangles from {} to {}, got {} from {} on", subject,
           number, next + 1, count, piece.count, piece.first + 1);
    next = piece.first + piece.count;
    if (!lies_on(table.mesh, piece))
      fail("{}: round solid {}: expected triangles whose vertices lie on its surface", subject,
           number);
  }
}

MeshTable read_mesh_table(lua_State* L, int i, const ReadOptions& reading) {
  Table table(L, i, subject(L) + ": mesh");
  MeshTable out;
  Mesh& mesh = out.mesh;
  int number = 0;
  for (const auto& row : table.rows("vertices", 3)) {
    ++number;
    mesh.vertices.emplace_back(row[0], row[1], row[2]);
    check(coordinate_rule, mesh.vertices.back(),
          fmt::format("{}: vertex {}", table.subject(), number));
  }
  const int count = number;
  number = 0;
  for (const auto& row : table.rows("triangles", 3)) {
    ++number;
    Triangle t;
    for (int k = 0; k < 3; ++k) {
      if (!(row[k] >= 1 && row[k] <= count && row[k] == std::floor(row[k])))
        fail("{}: triangle {}: expected vertices from 1 to {}, got {}", table.subject(), number,
             count, row[k]);
      t[k] = floor_int(row[k]) - 1;
    }
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
  }
  const int round = table.type("round");
  const bool looked_for = round == LUA_TBOOLEAN && table.boolean("round", false);
  if (round != LUA_TBOOLEAN && round != LUA_TNIL)
    table.each("round", "true or a list of round solids", [&](int item, const What& what) {
      out.rounds.pieces.push_back(read_round(L, item, what.text()));
    });
  table.done();
  if (number == 0) fail("{}: expected at least one triangle, got none", table.subject());
  const size_t left_out = static_cast<size_t>(number) - mesh.triangles.size();
  if (mesh.triangles.empty())
    fail("{}: expected a triangle of three different vertices, got none", table.subject());
  if (left_out > 0)
    reading.diagnostics.repaired(Place("", 0, table.subject()),
                                 "{} of {} triangles name a vertex twice and are left out",
                                 left_out, number);
  if (turn_outward(mesh))
    reading.diagnostics.repaired(Place("", 0, table.subject()), "{}",
                                 std::string_view(inside_out).substr(2));
  if (looked_for) out.rounds.pieces = round_parts(mesh);
  if (round == LUA_TTABLE) check_rounds(out, table.subject());
  return out;
}

}  // namespace clench
