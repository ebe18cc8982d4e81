#include <nlohmann/json.hpp>

#include "case_with.h"
#include "io/records/run_tables.h"
#include "report/pages/page.h"
#include "sample_result.h"
#include "subimpact/case/simulate.h"
#include "testing.h"

namespace subimpact {
namespace {

using Json = nlohmann::json;

std::string bytes_of(const std::string& base64) {
  static const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int n = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    n += 6;
    if (n < 8) continue;
    n -= 8;
    bytes.push_back(static_cast<char>(bits >> n));
  }
  return bytes;
}

template <class Number>
std::vector<double> numbers_of(const std::string& base64) {
  const std::string bytes = bytes_of(base64);
  std::vector<double> numbers;
  for (std::size_t i = 0; i + sizeof(Number) <= bytes.size(); i += sizeof(Number)) {
    Number number;
    std::memcpy(&number, bytes.data() + i, sizeof number);
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<double> i24_of(const Json& column) {
  const std::string bytes = bytes_of(column.at("i24"));
  std::vector<double> numbers;
  for (std::size_t i = 0; i + 3 <= bytes.size(); i += 3) {
    unsigned n = 0;
    for (std::size_t k = 3; k-- > 0;) n = n << 8 | static_cast<unsigned char>(bytes[i + k]);
    numbers.push_back((static_cast<int>(n << 8) >> 8) * column.at("step").get<double>());
  }
  return numbers;
}

Case short_case(const std::vector<std::string>& settings = {}) {
  return paper_case_with({"time.end=3e-4", "model.segments=51"}, settings);
}

TEST(PageData, HoldsTheHistoryToTheDigitsOfFloats) {
  const Case input = short_case();
  const Result result = simulate(input);
  const Json json = Json::parse(page_data(input, result).json);
  const auto times = numbers_of<double>(json.at("history").at("time_s").at("f64"));
  const auto forces = numbers_of<float>(json.at("history").at("force_N").at("f32"));
  ASSERT_EQ(times.size(), result.history.size());
  ASSERT_EQ(forces.size(), result.history.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    ASSERT_EQ(times[i], result.history[i].time);
    ASSERT_NEAR(forces[i], result.history[i].force, 6e-8 * result.max_force);
  }
}

TEST(PageData, HoldsEveryColumnOfTheHistoryWithItsMeaning) {
  const Case input = short_case({"beam.ends=[\"pinned\", \"free\"]"});
  const Result result = simulate(input);
  const Json json = Json::parse(page_data(input, result).json);
  for (const auto& column : run_table<HistoryRow>().columns) {
    ASSERT_TRUE(json.at("history").contains(column.name)) << column.name;
    if (column.name == "time_s") continue;
    EXPECT_EQ(json.at("meanings").at(column.name), column.meaning);
  }
  const auto reactions = numbers_of<float>(json.at("history").at("R_0_N").at("f32"));
  const auto absent = numbers_of<float>(json.at("history").at("R_l_N").at("f32"));
  ASSERT_EQ(reactions.size(), result.history.size());
  for (std::size_t i = 0; i < reactions.size(); ++i) {
    const double reaction = result.history[i].first_reaction.value();
    ASSERT_NEAR(reactions[i], reaction, 6e-8 * std::abs(reaction));
    ASSERT_TRUE(std::isnan(absent[i]));
  }
}

TEST(PageData, HoldsEveryShapeToAMillionthOfTheLargest) {
  const Case input = short_case();
  const Result result = simulate(input);
  const Json shapes = Json::parse(page_data(input, result).json).at("shapes");
  const auto moments = i24_of(shapes.at("moment"));
  const auto plastic = i24_of(shapes.at("plastic"));
  const auto where = shapes.at("plastic_points").get<std::vector<std::size_t>>();
  const std::size_t n = result.used.n_shape_points;
  ASSERT_EQ(moments.size(), result.shapes.size());
  ASSERT_EQ(plastic.size(), result.shapes.size() / n * where.size());
  double largest = 0.0, largest_plastic = 0.0;
  for (const ShapeRow& row : result.shapes) {
    largest = std::max(largest, std::abs(row.moment));
    largest_plastic = std::max(largest_plastic, std::abs(row.plastic_curvature));
  }
  ASSERT_GT(largest_plastic, 0.0);
  std::vector<double> whole(result.shapes.size(), 0.0);
  for (std::size_t i = 0; i < plastic.size(); ++i) {
    whole[i / where.size() * n + where[i % where.size()]] = plastic[i];
  }
  for (std::size_t i = 0; i < moments.size(); ++i) {
    ASSERT_NEAR(moments[i], result.shapes[i].moment, 1e-7 * largest);
    ASSERT_NEAR(whole[i], result.shapes[i].plastic_curvature, 1e-7 * largest_plastic);
  }
}

TEST(PageData, OfALongHistoryKeepsPeaksOfOneRowAndStatesWhatItLeavesOut) {
  Result result = sample_result();
  result.history.assign(300'000, HistoryRow{});
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    result.history[i].time = 1e-8 * static_cast<double>(i);
  }
  result.history[123'457].force = 5e3;
  result.history[200'001].struck_deflection = -1e-3;
  const PageData data = page_data(short_case(), result);
  const Json history = Json::parse(data.json).at("history");
  const auto forces = numbers_of<float>(history.at("force_N").at("f32"));
  const auto deflections = numbers_of<float>(history.at("f_c_m").at("f32"));
  EXPECT_LT(forces.size(), 25'000u);
  EXPECT_EQ(std::ranges::max(forces), 5e3);
  EXPECT_NEAR(std::ranges::min(deflections), -1e-3, 1e-9);
  expect_in(data.history_note, "Of 300000 rows");
}

TEST(PageData, OfFineShapesKeepsThoseAtEventsAndTheStruckPoint) {
  Case input = short_case();
  input.scene.striker.position = 0.3;
  Result result = sample_result();
  result.used.n_shape_points = 3001;
  const std::size_t n_shapes = 600;
  for (std::size_t k = 0; k < n_shapes; ++k) {
    for (std::size_t i = 0; i < 3001; ++i) {
      ShapeRow row{};
      row.time = 1e-6 * static_cast<double>(k);
      row.position = input.scene.beam.length * static_cast<double>(i) / 3000.0;
      result.shapes.push_back(row);
    }
  }
  result.transitions = {{317e-6, EventKind::contact_begins, std::nullopt, 0.0}};
  const PageData data = page_data(input, result);
  EXPECT_LT(data.json.size(), 3e6);
  const Json shapes = Json::parse(data.json).at("shapes");
  const auto times = numbers_of<double>(shapes.at("times").at("f64"));
  const auto positions = numbers_of<double>(shapes.at("positions").at("f64"));
  EXPECT_EQ(std::ranges::count(times, 317e-6), 1);
  EXPECT_TRUE(std::ranges::any_of(
      positions, [&](double x) { return std::abs(x - 0.3 * input.scene.beam.length) < 1e-9; }));
  expect_in(data.shapes_note, "of 600 shapes");
}

TEST(PageData, EndsNoScriptElement) {
  const Result result = sample_result();
  EXPECT_EQ(comparison_data({"</script><!--", "&"}, {&result, &result}).find('<'),
            std::string::npos);
}

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
