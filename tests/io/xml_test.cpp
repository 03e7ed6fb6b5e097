#include "clench/io/text/xml.h"

#include "clench/base/random.h"
#include "clench/base/text.h"

using namespace clench;

static std::vector<std::string> warnings_of(const std::string& text, const XmlKnown& known) {
  const XmlFile file("a.xml", text);
  std::vector<std::string> out;
  file.root().check(known, Diagnostics([&](const Diagnostic& diagnostic) {
                      out.push_back(diagnostic.sentence());
                    }));
  return out;
}

TEST_CASE("elements, texts and attributes stand where the file has them") {
  const XmlFile file("a.xml",
                     "<?xml version=\"1.0\"?>\n<!-- head -->\n<a b=' x &amp; y '>\n  <c> 1 <!-- no "
                     "--> 2 </c>\n  <d/><c>3</c>\n</a>\n");
  const XmlElement root = file.root();
  CHECK(root.name() == "a");
  CHECK(root.line() == 3);
  CHECK(root.attribute("b") == "x & y");
  CHECK_FALSE(root.attribute("c"));
  CHECK(root.children().size() == 3);
  CHECK(root.children("c").size() == 2);
  CHECK(root.child("c").numbers() == std::vector<double>{1, 2});
  CHECK(root.children("c")[1].place().text() == "a.xml:5");
  CHECK_FALSE(root.child("e"));
  CHECK(root.child("d").text().empty());
}

TEST_CASE("values that are not as expected are told with their place") {
  const XmlFile file("a.xml", "<a n=\"x\">\n<b>1.5</b><c>12 0</c>\n<d><e/></d><f>7</f></a>");
  const XmlElement root = file.root();
  CHECK_THROWS_WITH_AS(root.expected("g"), "a.xml:1: a: expected an element <g>, got none", Error);
  CHECK_THROWS_WITH_AS(root.child("b").integer(), "a.xml:2: b: expected a whole number, got '1.5'",
                       Error);
  CHECK_THROWS_WITH_AS(root.child("c").vector(), "a.xml:2: c: expected 3 numbers, got 2", Error);
  CHECK_THROWS_WITH_AS(root.child("c").number(), "a.xml:2: c: expected a number, got '12 0'",
                       Error);
  CHECK_THROWS_WITH_AS(root.child("d").text(), "a.xml:3: d: expected text, got an element <e>",
                       Error);
  CHECK_THROWS_WITH_AS(root.child("f").integer(0, 5),
                       "a.xml:3: f: expected a whole number from 0 to 5, got '7'", Error);
  CHECK_THROWS_WITH_AS(root.child("f").integer(8),
                       "a.xml:3: f: expected a whole number >= 8, got '7'", Error);
  CHECK_THROWS_WITH_AS(root.expected_attribute("m"),
                       "a.xml:1: a: expected an attribute 'm', got none", Error);
  CHECK_THROWS_WITH_AS(root.number_attribute("n"), "a.xml:1: a: n: expected a number, got 'x'",
                       Error);
  CHECK_THROWS_WITH_AS(root.integer_attribute("n"),
                       "a.xml:1: a: n: expected a whole number, got 'x'", Error);
}

TEST_CASE("what is not known, stands twice, or is text among elements is warned of") {
  const auto list = warnings_of("<a tpe='x'>junk\n<mass>1</mass>\n<mass>2</mass><mas/>\n</a>",
                                {.once = {"mass"}, .attributes = {"type"}});
  REQUIRE(list.size() == 4);
  CHECK(list[0] == "a.xml:3: <mass> stands in <a> again; the first one counts");
  CHECK(list[1] == "a.xml:3: unknown element <mas> in <a> is not used; did you mean 'mass'?");
  CHECK(list[2] == "a.xml:1: unknown attribute 'tpe' of <a> is not used; did you mean 'type'?");
  CHECK(list[3] == "a.xml:1: text 'junk' in <a> is not used");
  CHECK(warnings_of("<a>text</a>", {}).empty());
}

TEST_CASE("files beyond all measure are refused before the parser sees them") {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  CHECK_THROWS_WITH_AS(XmlFile("a.xml", deep),
                       "a.xml:1: expected at most 64 elements in each other", Error);
  std::string wide = "<a ";
  for (int i = 0; i < 5000; ++i) wide += "x='1' ";
  CHECK_THROWS_WITH_AS(XmlFile("a.xml", wide + "/>"),
                       "a.xml:1: expected at most 1000 attributes, got 5000", Error);
  CHECK_THROWS_WITH_AS(XmlFile("a.xml", std::string(17 << 20, ' ')),
                       "a.xml: expected at most 16 MB of XML, got 17", Error);
  CHECK_THROWS_WITH_AS(XmlFile("a.xml", std::string("<a>\n\0</a>", 9)),
                       "a.xml:2: expected text, got a zero byte", Error);
}

TEST_CASE("entities of a file's own are refused, for they would stand in names as they are") {
  const std::string own = "<!DOCTYPE a [<!ENTITY who 'x'>]>\n";
  const std::string sentence =
      ": the entity '&who;' is not read; expected &amp; &lt; &gt; &quot; or &apos;";
  CHECK_THROWS_WITH_AS(XmlFile("a.xml", own + "<a>\n&who;</a>"), ("a.xml:3" + sentence).c_str(),
                       Error);
  CHECK_THROWS_WITH_AS(XmlFile("a.xml", own + "<a b='&who;'/>"), ("a.xml:2" + sentence).c_str(),
                       Error);
  CHECK(XmlFile("a.xml", own + "<a><!-- &who; -->&amp;&#65; & co; <b/></a>").root().loose_text() ==
        "&A & co;");
}

TEST_CASE("as many elements as one needs are no matter") {
  std::string text = "<a>";
  for (int i = 0; i < 20000; ++i) text += "<b x='1'>2</b>\n";
  const XmlFile file("a.xml", text + "</a>");
  CHECK(file.root().children("b").size() == 20000);
  CHECK(file.root().children().back().line() == 20000);
}

TEST_CASE("the outermost element's name is found without reading on") {
  CHECK(xml_root_name("<?xml?>\n<!-- <no> -->\n<robot type='x'><broken") == "robot");
  CHECK(xml_root_name("<world/>") == "world");
  CHECK(xml_root_name("no element") == "");
  CHECK(xml_root_name("<!-- no end") == "");
}

TEST_CASE("escaped text is read back") {
  const std::string text = "a < b & \"c\" > 'd'";
  const XmlFile file("a.xml", "<a>" + xml_escaped(text) + "</a>");
  CHECK(file.root().text() == text);
}

TEST_CASE("what is no well-formed XML is told with its line") {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      XmlFile("a.xml", text);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  const std::string expected = "expected well-formed XML, got ";
  CHECK(refusal("<a>\n<b>\n</c>\n</a>") == "a.xml:2: " + expected + "<b> without its closing tag");
  CHECK(refusal("<a>\n<b\nc='1'\n") ==
        "a.xml:2: " + expected + "<b> that does not end, or has no name");
  CHECK(refusal("<a>\n <b>\n  text\n\n\n") ==
        "a.xml:3: " + expected + "text outside all elements, or in one that does not end");
  for (const char* attribute : {"c=1", "c=", "c", "c='1", "c='1' c='2'"})
    CHECK(refusal(fmt::format("<a>\n<b {}/></a>", attribute)) ==
          "a.xml:2: " + expected +
              "<b> with an attribute that is repeated or has no value in quotes");
  CHECK(refusal("<a 'b'/>") == "a.xml:1: " + expected + "a tag that does not end, or has no name");
  CHECK(refusal("<a>1 < 2</a>") ==
        "a.xml:1: " + expected + "an element that does not end, or a '<' that begins no element");
  CHECK(refusal("<a>\n<!-- no end </a>") == "a.xml:2: " + expected + "a comment that does not end");
  CHECK(refusal("<a>\n<![CDATA[ no end </a>") ==
        "a.xml:2: " + expected + "CDATA that does not end");
  // the parser would omit the rest
  CHECK(refusal("<a></a>\n</a>\n<b/>") == "a.xml:2: '</a>' closes nothing");
  // names are shortened and have no control characters
  CHECK(refusal("<" + std::string(1000, 'x') + "></a>") == "a.xml:1: " + expected + "<" +
                                                               std::string(max_excerpt, 'x') +
                                                               "...> without its closing tag");
  CHECK(refusal("<a\x1B[2J></b>").find('\x1B') == std::string::npos);
}
