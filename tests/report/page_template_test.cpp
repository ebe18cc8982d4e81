#include "report/page_template.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace subimpact {
namespace {

TEST(APage, HasTextsEscapedOrAsTheyAre) {
  const Fields fields{{{"a", "<1 & \"2\">"}}, {}};
  EXPECT_EQ(filled("a: {{a}}, {{{a}}}.", fields), "a: &lt;1 &amp; &quot;2&quot;&gt;, <1 & \"2\">.");
  EXPECT_EQ(filled("a { b } c", {}), "a { b } c");
}

TEST(APage, RepeatsAPartPerEntryOfAListAndEntriesHideWhatIsAroundThem) {
  const Fields entry{{{"a", "inner"}}, {}};
  const Fields empty;
  const Fields fields{{{"a", "outer"}}, {{"list", {entry, empty}}, {"none", {}}}};
  EXPECT_EQ(filled("{{#list}}[{{a}}]{{/list}}{{#none}}[{{a}}]{{/none}}{{a}}", fields),
            "[inner][outer]outer");
  const Fields nested{{{"b", "1"}}, {{"outer", {{{}, {{"inner", {entry, entry}}}}}}}};
  EXPECT_EQ(filled("{{#outer}}{{#inner}}{{a}}{{b}} {{/inner}}{{/outer}}", nested),
            "inner1 inner1 ");
}

TEST(APage, IsRefusedIfAFieldOrAnEndIsMissing) {
  EXPECT_THROW(filled("{{a}}", {}), std::logic_error);
  EXPECT_THROW(filled("{{#a}}{{/a}}", {}), std::logic_error);
  EXPECT_THROW(filled("{{a", {{{"a", ""}}, {}}), std::logic_error);
  EXPECT_THROW(filled("{{#a}}", {{}, {{"a", {}}}}), std::logic_error);
}

}  // namespace
}  // namespace subimpact
