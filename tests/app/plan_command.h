// Helpers of the tests of `clench plan`.
#pragma once
#include "command.h"

namespace clench::test {

inline const std::string barrett = "plan models/hands/barrett/barrett.cfg models/objects/flask.iv ";

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// the values of `epsilon` in a list of grasps, as clench reads them
inline std::string epsilons(const std::string& path) {
  return run("-q -e 'for _, g in ipairs(clench.grasps(\"" + path + "\")) do print(g.epsilon) end'")
      .out;
}

// a cube as an OBJ file [m]
inline std::string cube_of(double side) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", side * ((i & 1) ^ (i >> 1 & 1)), side * (i >> 1 & 1),
                        side * (i >> 2));
  return text +
         "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\n"
         "f 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";
}

// output of a shell script
inline std::string output_of(const std::string& script) {
  const Folder folder;
  FILE* pipe = popen(("bash " + folder.file("script.sh", script) + " 2>&1").c_str(), "r");
  std::string text;
  char buffer[4096];
  while (const size_t count = fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, count);
  pclose(pipe);
  return text;
}

// starts a command, waits until a file has three lines, and sends a signal
inline std::string end_by(const std::string& signal, const std::string& command,
                          const std::string& out, const std::string& before = "") {
  return output_of(std::string(CLENCH_COMMAND) + " " + command +
                   " & pid=$!\n"
                   "while [ $(cat " +
                   out + " 2>/dev/null | wc -l) -lt 3 ]; do sleep 0.05; done\n" + before +
                   "\nkill -" + signal + " $pid\nwait $pid 2>/dev/null\necho code $?\n");
}

}  // namespace clench::test
