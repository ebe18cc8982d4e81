#include "subimpact/io/read_results.h"
#include "subimpact/simulate/error.h"
#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

Signal signal_of(const std::string& text) {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory.path / "force.csv";
  std::ofstream(file) << text;
  return read_signal(file);
}

std::string refusal(const std::string& text) {
  try {
    signal_of(text);
  } catch (const ResultsError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(ReadSignal, TakesUnitsFromTheHeading) {
  for (const char* text :
       {"time_us,force_kN\n-1,0.0\n0,1.5\n1,2e0\n",
        "t [us],channel 1,F [kN]\n-1,9,0\n0,9,1.5\n1,9,2\n",
        "\xef\xbb\xbf\"time, µs\";\"force (kN)\"\r\n-1;0\r\n0;1.5\r\n1;2\r\n",
        "v_m_per_s\ttime_ns\tforce N\n1\t-1000\t0\n2\t0\t 1500\n3\t1000\t2000\n\n"}) {
    const Signal signal = signal_of(text);
    ASSERT_EQ(signal.times.size(), 3u) << text;
    EXPECT_DOUBLE_EQ(signal.times[0], -1e-6) << text;
    EXPECT_DOUBLE_EQ(signal.times[2], 1e-6) << text;
    EXPECT_DOUBLE_EQ(signal.forces[1], 1500.0) << text;
  }
}

TEST(ReadSignal, NamesWhatIsWrong) {
  expect_in(refusal("time,force\n0,1\n"),
            "no column's name ends in a unit of time (s, ms, us, ns)");
  expect_in(refusal("time_s,force\n0,1\n"),
            "no column's name ends in a unit of force (N, mN, kN, MN)");
  expect_in(refusal("time_s,F1_N,F2_N\n0,1,1\n"), "several columns (F1_N, F2_N)");
  expect_in(refusal("time_s,force_N\n0,1\n1,x\n2,1\n"), "force.csv:3: force_N is \"x\"");
  expect_in(refusal("time_s,force_N\n0,1\n1,nan\n2,1\n"), "force_N is \"nan\"");
  expect_in(refusal("time_s,force_N\n0,1\n0,1\n2,1\n"),
            "force.csv:3: time_s is \"0\"; allowed: a time later");
  expect_in(refusal("time_s;force_N\n0;1\n1;1,5\n"), "force.csv:3: has a comma within a number");
  expect_in(refusal("time_s,force_N\n0,1\n1,1,5\n"), "has 3 cells where the header has 2");
  expect_in(refusal("time_s,force_N\n0,1\n1,1\n"), "has 2 rows of numbers");
  expect_in(refusal(""), "has no heading");
}

TEST(ReadSignal, ReadsOfSeveralForcesTheOneNamedForce) {
  EXPECT_EQ(signal_of("time_s,R_N,force_N\n0,1,2\n1,1,2\n2,1,2\n").forces[0], 2.0);
}

}  // namespace
}  // namespace subimpact
