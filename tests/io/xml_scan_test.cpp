#include "io/xml_scan.h"

#include <fmt/format.h>

#include "base/error.h"
#include "io/xml.h"

using namespace clench;

static std::string fault_of(const std::string& text) {
  // only what the parser refuses is asked about
  CHECK_THROWS_AS(XmlFile("a.xml", text), Error);
  const auto fault = find_xml_fault(text);
  return fault ? fmt::format("{}: {}", fault->line, fault->sentence) : "";
}

TEST_CASE("a closing tag of another name is told with both names and both lines") {
  CHECK(fault_of("<a>\n<b>\n</c>\n</a>") ==
        "3: expected </b>, which closes the <b> of line 2, got </c>");
  CHECK(fault_of("<a>\n<!-- <x> -->\n<![CDATA[ </y> ]]>\n<b c='<'/>\n</d>") ==
        "5: expected </a>, which closes the <a> of line 1, got </d>");
  // the parser lets these pass
  CHECK(find_xml_fault("<a></a>\n</a>").value().sentence == "</a> closes nothing");
  CHECK(find_xml_fault("<a>\n</a ").value().sentence ==
        "expected '>' after </a, got the end of the file");
}

TEST_CASE("a file that ends too soon is told with its last line") {
  CHECK(fault_of("<a>\n <b>\n  text\n\n\n") ==
        "3: expected </b>, which closes the <b> of line 2, got the end of the file");
  CHECK(fault_of("<a>\n<b\nc='1'\n") ==
        "3: expected the end of the tag <b that begins in line 2, got the end of the file");
  CHECK(fault_of("<a>\n<b c=\n") ==
        "2: <b>: attribute 'c': expected a value in quotes, got the end of the file");
  CHECK(fault_of("<a>\n<b c='1\n</a>") == "2: <b>: attribute 'c': its value does not end");
}

TEST_CASE("what is wrong with an attribute is told") {
  CHECK(fault_of("<a>\n<b c=1/></a>") ==
        "2: <b>: attribute 'c': expected a value in quotes, got '1/'");
  CHECK(fault_of("<a\nb='1'\nb=\"2\"/>") == "3: <a>: the attribute 'b' stands there twice");
  CHECK(fault_of("<a b/>") == "1: <a>: expected '=' and a value after the attribute 'b', got '/'");
  CHECK(fault_of("<a 'b'/>") == "1: <a>: expected an attribute or '>', got ''b'/'");
  CHECK(fault_of("<a>1 < 2</a>") == "1: expected the name of an element after '<', got ' 2</a'");
}

TEST_CASE("what is wrong with anything but tags is left to the parser") {
  CHECK(fault_of("<a>\n<!-- no end </a>").empty());
  CHECK(fault_of("<a>\n<![CDATA[ no end </a>").empty());
  CHECK(fault_of("mass 3").empty());
}

TEST_CASE("a long name is cut short in a message and has no control characters") {
  const std::string name(1000, 'x');
  CHECK(fault_of("<" + name + "></a>") ==
        fmt::format("1: expected </{0}>, which closes the <{0}> of line 1, got </a>",
                    std::string(40, 'x') + "..."));
  CHECK(fault_of("<a\x1B[2J></b>") ==
        "1: expected </a?[2J>, which closes the <a?[2J> of line 1, got </b>");
}
