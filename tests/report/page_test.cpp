#include "report/page.h"

#include "testing.h"

namespace subimpact {
namespace {

TEST(APage, HasTextsEscapedOrAsTheyAre) {
  const Json fields = {{"a", "<1 & \"2\">"}, {"n", 3}};
  EXPECT_EQ(filled("a: {{a}}, {{{a}}}, {{n}}.", fields),
            "a: &lt;1 &amp; &quot;2&quot;&gt;, <1 & \"2\">, 3.");
  EXPECT_EQ(filled("a { b } c", {}), "a { b } c");
}

TEST(APage, RepeatsAPartPerEntryOfAListAndEntriesHideWhatIsAroundThem) {
  const Json entry = {{"a", "inner"}}, empty = Json::object();
  const Json fields = {
      {"a", "outer"}, {"list", Json::array({entry, empty})}, {"none", Json::array()}};
  EXPECT_EQ(filled("{{#list}}[{{a}}]{{/list}}{{#none}}[{{a}}]{{/none}}{{a}}", fields),
            "[inner][outer]outer");
  const Json inner = {{"inner", Json::array({entry, entry})}};
  const Json nested = {{"b", "1"}, {"outer", Json::array({inner})}};
  EXPECT_EQ(filled("{{#outer}}{{#inner}}{{a}}{{b}} {{/inner}}{{/outer}}", nested),
            "inner1 inner1 ");
  EXPECT_EQ(filled("{{#words}}{{.}};{{/words}}", {{"words", Json::array({"a", "<"})}}), "a;&lt;;");
}

TEST(APage, LeavesAPartOutForAFieldThatIsEmptyFalseOrNull) {
  const Json fields = {{"a", "text"}, {"b", ""}, {"c", false}, {"d", nullptr}, {"e", true}};
  EXPECT_EQ(filled("{{#a}}{{a}}{{/a}}{{#b}}b{{/b}}{{#c}}c{{/c}}{{#d}}d{{/d}}{{#e}}e{{/e}}", fields),
            "texte");
}

TEST(APage, IsRefusedIfAFieldOrAnEndIsMissing) {
  const Json fields = {{"a", ""}};
  EXPECT_THROW(filled("{{a}}", {}), std::logic_error);
  EXPECT_THROW(filled("{{#a}}{{/a}}", {}), std::logic_error);
  EXPECT_THROW(filled("{{a", fields), std::logic_error);
  EXPECT_THROW(filled("{{#a}}", fields), std::logic_error);
}

}  // namespace
}  // namespace subimpact
