// Output for file names, and names in files, that contain control sequences of terminals.
#include "clench/base/printable.h"
#include "command.h"

using namespace clench::test;

// escape sequences, a forged line, a C1 control and changes of text direction
static const std::string hostile =
    "\x1b[31m\r\nerror: forged \xC2\x9B"
    "31m \xE2\x80\xAE gpj \xE2\x81\xA6";

/// Is a text free of them, except for the line ends and blanks of the output itself?
static bool is_shown(const std::string& text) {
  bool shown = true;
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\n' && text[i] != '\t' && clench::control_size(text, i) > 0) shown = false;
  if (!shown) MESSAGE("got: ", text);
  return shown;
}
static bool forges_line(const std::string& text) {
  const bool forges = text.find("\nerror: forged") != std::string::npos;
  if (forges) MESSAGE("got: ", text);
  return forges;
}

TEST_CASE("control characters of terminals are shown in escaped form and not sent") {
  const Folder folder;
  const auto path = [&](const std::string& ending) { return folder / ("a" + hostile + ending); };
  const auto shell = [&](const std::string& ending) { return "'" + path(ending) + "'"; };
  std::string xml = hostile;
  for (const auto& [raw, escaped] :
       {std::pair{std::string("\x1b"), std::string("&#27;")}, {"\r", "&#13;"}, {"\n", "&#10;"}})
    if (const size_t at = xml.find(raw); at != std::string::npos)
      xml.replace(at, raw.size(), escaped);
  // names in files
  const std::string links = "<link name='a" + xml + "'/><link name='b'/><joint name='j" + xml +
                            "' type='revolute'><parent link='a" + xml + "'/><child link='b'/>" +
                            "<mimic joint='k" + xml + "'/><limit lower='0' upper='1'/></joint>";
  folder.file("names.urdf", "<robot name='r" + xml + "'>" + links + "</robot>");
  folder.file("odd.urdf", "<robot name='r'><" + std::string("link name='a" + xml + "'>") +
                              "<nonsense" + "/></link></robot>");
  folder.file("w.wld", "#GraspIt! version 2.0\nGraspableBody\n" + hostile + ".iv\n");
  folder.file("g.jsonl", "{\"format\":\"clench grasps\",\"version\":1}\n{\"hand\":\"" + hostile);
  // files of such names
  folder.file("a" + hostile + ".wld", "nonsense");
  folder.file("a" + hostile + ".xml", "<nonsense/>");
  fs::copy_file("models/objects/flask.iv", path(".iv"));
  const std::string files = (folder / "names.urdf") + " " + (folder / "odd.urdf") + " " +
                            (folder / "w.wld") + " " + (folder / "g.jsonl") + " " + shell(".wld") +
                            " " + shell(".xml") + " " + shell(".iv") + " " + shell(".none");
  for (const std::string& arguments :
       {"check " + files, "check --json " + files, "check --strict " + files,
        "convert " + shell(".wld") + " " + (folder / "x.lua"),
        "convert " + shell(".iv") + " " + shell(".nonsense"),
        "plan " + shell(".wld") + " " + shell(".iv"), "test " + shell(".none")}) {
    CAPTURE(arguments.substr(0, 10));
    const std::string out = run(arguments).out;
    CHECK(is_shown(out));
    CHECK_FALSE(forges_line(out));
  }
  // line breaks in a script's own messages are kept
  for (const std::string& arguments :
       {"run " + shell(".none"), shell(".none"), "-e \"clench.load[[" + path(".wld") + "]]\"",
        "-e \"clench.log.warning[[" + path("") + "]]\"", "-e \"error[[" + path("") + "]]\"",
        "-e \"print(require 'clench.show' {[[" + hostile + "]]})\""}) {
    CAPTURE(arguments.substr(0, 10));
    CHECK(is_shown(run(arguments).out));
  }
  CHECK(has(run("check " + shell(".iv")).out, "a?[31m??error: forged ?31m ? gpj ?.iv: a body"));
}
