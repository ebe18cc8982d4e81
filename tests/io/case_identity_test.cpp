#include "small_case.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "testing.h"

namespace subimpact {
namespace {

std::string identity(const LoadedCase& loaded, const std::string& how = {}) {
  return case_identity(loaded.value, loaded.given, how);
}

TEST(CaseIdentity, ChangesWithEveryNumberButTheTitle) {
  const LoadedCase base = read_case_text(small_case_text(), "case");
  std::set<std::string> seen = {identity(base)};
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(base.value);
    if (!value || !std::holds_alternative<double>(*value)) continue;
    LoadedCase other = base;
    key.set(other.value, std::nextafter(std::get<double>(*value), 0.0) + 1e-300);
    EXPECT_TRUE(seen.insert(identity(other)).second) << key.name;
  }
  LoadedCase titled = base;
  titled.value.title = "another";
  EXPECT_EQ(identity(titled), identity(base));
}

TEST(CaseIdentity, ChangesWithWhatIsLeftToTheProgramAndHowACaseIsRun) {
  const LoadedCase open = read_case_text(small_case_text(), "case");
  LoadedCase fixed = read_case_text(small_case_text() + "[model]\nsegments = 501\n", "case");
  EXPECT_EQ(fixed.value.model.segments, open.value.model.segments);
  EXPECT_NE(identity(fixed), identity(open));
  EXPECT_NE(identity(open, "without error bars"), identity(open));
  EXPECT_EQ(identity(open).size(), 32u);
}

}  // namespace
}  // namespace subimpact
