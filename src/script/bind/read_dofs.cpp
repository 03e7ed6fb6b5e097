#include <optional>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/model/dof.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/values.h"

namespace clench {

int dof_named(const std::string& name, const RobotHandle& robot, const What& what) {
  std::vector<std::string> names;
  for (int d = 0; d < static_cast<int>(robot->dofs.size()); ++d) {
    names.push_back(dof_name(*robot, d));
    if (names.back() == name) return d;
  }
  fail("{}: robot '{}' has no DOF '{}'{}", what.text(), robot->name, name, instead_of(name, names));
}

std::vector<std::string> read_dof_names(lua_State* L, int i, const What& what) {
  if (!lua_istable(L, i) || lua_rawlen(L, i) > 0) return {};
  return read_keys(L, i, what, "names of DOFs");
}

static std::vector<std::optional<double>> read_some_dofs(lua_State* L, int i, const What& what,
                                                         const RobotHandle& robot) {
  if (const auto names = read_dof_names(L, i, what); !names.empty()) {
    std::vector<std::optional<double>> out(robot->dofs.size());
    for (const std::string& name : names) {
      lua_getfield(L, i, name.c_str());
      out[static_cast<size_t>(dof_named(name, robot, what))] =
          read_number(L, lua_gettop(L), {L, what.subject, name});
      lua_pop(L, 1);
    }
    return out;
  }
  const auto values = read_numbers(L, i, what);
  if (values.size() != robot->dofs.size())
    fail("{}: robot '{}': expected {} DOF values, got {}",
         what.subject.empty() ? subject(L) : std::string(what.subject), robot->name,
         robot->dofs.size(), values.size());
  return {values.begin(), values.end()};
}

std::vector<std::optional<double>> check_some_dofs(lua_State* L, int i, const RobotHandle& robot) {
  return read_some_dofs(L, i, {L, {}, "values"}, robot);
}

Eigen::VectorXd read_dofs(lua_State* L, int i, const What& what, const RobotHandle& robot) {
  Eigen::VectorXd out = robot.world->dofs(robot.id);
  const auto some = read_some_dofs(L, i, what, robot);
  for (size_t d = 0; d < some.size(); ++d)
    if (some[d]) out[static_cast<int>(d)] = *some[d];
  return out;
}

Eigen::VectorXd check_dofs(lua_State* L, int i, const RobotHandle& robot) {
  return read_dofs(L, i, {L, {}, "values"}, robot);
}

std::vector<int> read_dof_numbers(lua_State* L, int i, const What& what, const RobotHandle& robot) {
  const int count = read_list_size(L, i, what, "a list of DOFs"),
            most = static_cast<int>(robot->dofs.size());
  std::vector<int> out;
  for (int k = 1; k <= count; ++k) {
    const bool by_name = lua_rawgeti(L, i, k) == LUA_TSTRING;
    const What item = what.item(k);
    if (!by_name && lua_type(L, -1) != LUA_TNUMBER)
      fail_expected(item, "number or name of a DOF", lua_gettop(L));
    const int dof =
        by_name ? dof_named(read_string(L, -1, item), robot, item) : read_int(L, -1, item) - 1;
    if (dof < 0 || dof >= most)
      fail("{}: expected a DOF from 1 to {}, got {}", item.text(), most, dof + 1);
    out.push_back(dof);
    lua_pop(L, 1);
  }
  if (out.empty()) fail("{}: expected at least one DOF, got none", what.text());
  return out;
}

}  // namespace clench
