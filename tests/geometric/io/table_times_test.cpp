/// Times as other programs write them into tables.
#include "handway/geometric/io/table_times.h"

#include "handway/geometric/io/table_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;

constexpr double kMarch = 1709294400.0;  // 2024-03-01T12:00:00Z

double seconds(const std::string& cell) {
  const std::optional<SpelledTime> time = parse_time(cell);
  return time ? time->seconds : std::nan("");
}

TEST(SpelledTimes, AreDatesClocksAndBoth) {
  EXPECT_EQ(seconds("2024-03-01T12:00:00Z"), kMarch);
  EXPECT_NEAR(seconds("2024-03-01 12:00:00.016667"), kMarch + 0.016667, 1e-6);
  EXPECT_EQ(seconds("2024-03-01T13:00:00+01:00"), kMarch);
  EXPECT_EQ(seconds("2024-03-01T07:00:00-0500"), kMarch);
  EXPECT_EQ(seconds("2024/03/01 12:00"), kMarch);
  EXPECT_EQ(seconds("01.03.2024"), kMarch - 43200.0);
  EXPECT_EQ(seconds("03/01/2024 12:00:00 PM"), kMarch);
  EXPECT_EQ(seconds("31/12/2024"), 1735603200.0) << "no month is 31";
  EXPECT_NEAR(seconds("12:00:00,25"), 43200.25, 1e-9);
  EXPECT_EQ(seconds("1:00:00 pm"), 46800.0);
  EXPECT_EQ(seconds("12:30 am"), 1800.0);
  for (const char* none : {"12", "0.5", "abc", "1:2:3:4", "2024-13-01", "25:00", "12:61:00",
                           "2024-03-01T", "192.168.0.1", ""}) {
    EXPECT_FALSE(parse_time(none)) << none;
  }
}

TEST(TimeNames, HoldUnitsAndAreOfSeveralLanguages) {
  const auto unit = [](const char* name) {
    const std::optional<TimeName> found = time_name(name);
    return found ? found->unit.seconds.value_or(0.0) : -1.0;
  };
  for (const char* name : {"time", "t", "timestamp", "__time", "%time", "Zeit", "header.stamp",
                           "TIME", "Temps", "observation.timestamp"}) {
    EXPECT_EQ(unit(name), 0.0) << name;
  }
  for (const char* name : {"time [s]", "t_s", "Time (sec)", "seconds", "Zeit[s]"}) {
    EXPECT_EQ(unit(name), 1.0) << name;
  }
  for (const char* name : {"t_ms", "time_ms", "timems", "timestampMs", "ms", "Time [msec]"}) {
    EXPECT_EQ(unit(name), 1e-3) << name;
  }
  for (const char* name : {"time_us", "t [\u00B5s]", "timestamp_usec"}) {
    EXPECT_EQ(unit(name), 1e-6) << name;
  }
  for (const char* name : {"Timestamp_ns", "timestampNs", "time(ns)"}) {
    EXPECT_EQ(unit(name), 1e-9) << name;
  }
  for (const char* name : {"time [min]", "t_min", "minutes"}) {
    EXPECT_EQ(unit(name), 60.0) << name;
  }
  EXPECT_EQ(unit("time (h)"), 3600.0);
  for (const char* name :
       {"min", "h", "pan", "s", "temperature", "thumb", "seq", "frame_index", "", "tip"}) {
    EXPECT_EQ(unit(name), -1.0) << name;
  }
}

TEST(TimeNames, HoldUnitsThatAreNotKnown) {
  const auto unknown = [](const char* name) {
    const std::optional<TimeName> found = time_name(name);
    EXPECT_TRUE(found && (found->unit.unknown.empty() || !found->unit.seconds)) << name;
    return found ? found->unit.unknown : "none";
  };
  EXPECT_EQ(unknown("time [ticks]"), "ticks");
  EXPECT_EQ(unknown("time_ticks"), "ticks");
  EXPECT_EQ(unknown("Time (Frames)"), "frames");
  EXPECT_EQ(unknown("t [10 ms]"), "10 ms") << "not ms";
  for (const char* name : {"time", "time [s]", "Time (UTC)", "time [ms]", "time[0]", "t_ms"}) {
    EXPECT_EQ(unknown(name), "") << name;
  }
}

TEST(TimeColumns, AreOneOrPartsThatAddUp) {
  const auto columns = [](const std::vector<std::string>& names,
                          const std::vector<std::string>& row) {
    std::vector<CellContent> contents;
    for (const std::string& cell : row) {
      contents.push_back(content_of(cell));
    }
    std::vector<std::size_t> found;
    for (const TimeColumns::Part& part : time_columns(names, contents).parts) {
      found.push_back(part.column);
    }
    return found;
  };
  EXPECT_THAT(columns({"index", "timestamp", "pan"}, {"0", "0.1", "1"}), ElementsAre(1));
  EXPECT_THAT(columns({"Date", "Time", "pan"}, {"2024-03-01", "12:00:00", "1"}), ElementsAre(1, 0));
  EXPECT_THAT(columns({"Date", "Time", "pan"}, {"2024-03-01", "0.5", "1"}), ElementsAre(1));
  EXPECT_THAT(columns({"stamp.sec", "stamp.nanosec", "pan"}, {"5", "500", "1"}), ElementsAre(0, 1));
  EXPECT_THAT(columns({"reaction_time", "time"}, {"0", "1"}), ElementsAre(1)) << "plainly named";
  EXPECT_THAT(columns({"pan", "lift"}, {"0", "1"}), IsEmpty());
}

std::vector<double> settled(std::vector<double> times, std::optional<double> unit = {},
                            std::vector<std::string>* warnings = nullptr, bool spelled = false) {
  std::vector<std::string> said = settle_times(times, {unit}, spelled);
  if (warnings != nullptr) {
    *warnings = std::move(said);
  }
  return times;
}

TEST(SettledTimes, BeginAtZeroWhateverTheirUnitSince1970) {
  const std::vector<double> expected{0.0, 0.016, 0.033};
  for (const double unit : {1.0, 1e3, 1e6, 1e9}) {
    std::vector<double> times;
    for (const double time : expected) {
      times.push_back((kMarch + time) * unit);
    }
    EXPECT_THAT(settled(times), Pointwise(DoubleNear(2e-6), expected)) << unit;
  }
  EXPECT_THAT(settled({10000.0, 10000.5}), ElementsAre(10000.0, 10000.5)) << "not since 1970";
}

TEST(SettledTimes, KeepTheUnitOfTheHeaderUnlessItCanNotBe) {
  std::vector<std::string> warnings;
  EXPECT_THAT(settled({0.0, 16.7, 33.3}, 1e-3, &warnings),
              Pointwise(DoubleNear(1e-9), {0.0, 0.0167, 0.0333}));
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_THAT(settled({0.0, 20.0, 40.0}, 1.0, &warnings), ElementsAre(0.0, 20.0, 40.0));
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_THAT(settled({1e3 * kMarch, 1e3 * kMarch + 20.0}, 1.0, &warnings), ElementsAre(0.0, 0.02));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("the header says s for times, but")));
  EXPECT_THAT(settled({0.0, 0.02, 0.04}, 1e-9, &warnings), ElementsAre(0.0, 0.02, 0.04));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("the header says ns")));
}

TEST(SettledTimes, MayBeInMinutesOrSpelledBelowAUnit) {
  EXPECT_THAT(settled({0.5, 0.51, 0.52}, 60.0), Pointwise(DoubleNear(1e-9), {30.0, 30.6, 31.2}));
  EXPECT_THAT(settled({43200.0, 43200.5}, 1e-3, nullptr, true), ElementsAre(0.0, 0.5))
      << "a header such as \"Time (HH:MM:SS.ms)\"";
}

TEST(SettledTimes, AreFoundByTheirStepsWhereNoUnitIsNamed) {
  std::vector<std::string> warnings;
  EXPECT_THAT(settled({0.0, 17.0, 33.0}, {}, &warnings),
              Pointwise(DoubleNear(1e-9), {0.0, 0.017, 0.033}));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("taken for ms")));
  EXPECT_THAT(settled({5e12, 5e12 + 16666667.0}),
              Pointwise(DoubleNear(1e-6), {5000.0, 5000.016667}))
      << "ns since a computer's start";
  EXPECT_THAT(settled({0.0, 1.0, 2.0}), ElementsAre(0.0, 1.0, 2.0));
}

TEST(SettledTimes, SayHowAnUnknownUnitIsTaken) {
  std::vector<double> times{0.0, 20.0, 40.0};
  EXPECT_THAT(settle_times(times, {{}, "ticks"}),
              ElementsAre("the header says \"ticks\" for times, which is not a known unit (s, ms, "
                          "\u00B5s, ns, min, h): they are taken for ms, by their size and their "
                          "steps"));
  EXPECT_THAT(times, Pointwise(DoubleNear(1e-12), {0.0, 0.02, 0.04}));
}

TEST(SettledTimes, RunOnWhereTheClockWasSetBack) {
  std::vector<std::string> warnings;
  EXPECT_THAT(settled({0.0, 0.1, 0.2, 0.3, -5.0, -4.9, -4.8, -4.7, -4.6, -4.5}, {}, &warnings),
              Pointwise(DoubleNear(1e-9), {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("runs back by 5.3 s at row 5")));
  EXPECT_THAT(settled({0.0, 0.1, 0.3, 0.2, 0.4}, {}, &warnings),
              ElementsAre(0.0, 0.1, 0.3, 0.3, 0.4))
      << "one row came late";
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("1 row kept in the file's order")));
  EXPECT_THAT(settled({86399.5, 0.0, 0.5}, {}, &warnings, true),
              Pointwise(DoubleNear(1e-9), {0.0, 0.5, 1.0}))
      << "midnight";
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(SettledTimes, OfNothingAreNothing) {
  EXPECT_THAT(settled({}), IsEmpty());
  EXPECT_THAT(settled({3.0}), ElementsAre(3.0));
  EXPECT_TRUE(std::isnan(settled({std::nan("")}).front()));
}

TEST(Columns, TakeUnitsFromARowBelowTheirNames) {
  std::vector<std::string> names{"time", "pan", "label", "lift"};
  EXPECT_FALSE(append_units(names, {"0", "deg", "", "mm"}));
  EXPECT_FALSE(append_units(names, {"", "-", "", ""})) << "no unit";
  EXPECT_FALSE(append_units(names, {"s", "deg"}));
  EXPECT_EQ(names[1], "pan");
  EXPECT_TRUE(append_units(names, {"s", "[Deg]", "", "mm"}));
  EXPECT_THAT(names, ElementsAre("time [s]", "pan [deg]", "label", "lift [mm]"));
}

TEST(Cells, KeepSeparatorsWithinQuotes) {
  EXPECT_THAT(cells(R"("0,5","1,25",3)", ','), ElementsAre("0,5", "1,25", "3"));
  EXPECT_THAT(cells(R"(0,"['a', 'b']","[1, 2]")", ','), ElementsAre("0", "['a', 'b']", "[1, 2]"));
  EXPECT_THAT(cells(R"("2024-03-01 12:00" 1 2)", ' '), ElementsAre("2024-03-01 12:00", "1", "2"));
  EXPECT_THAT(cells(R"("0.5,1,2)", ','), ElementsAre("0.5", "1", "2")) << "no closing quote";
  EXPECT_EQ(parse_cell("0,25"), 0.25);
  EXPECT_FALSE(parse_cell("1,234,567"));
  EXPECT_EQ(separator_of(R"("0,5","1,25")"), ',');
  EXPECT_EQ(separator_of("0,5 1,25"), ' ');
  EXPECT_EQ(separator_of(R"(time,"pan; left")"), ',');
  EXPECT_EQ(separator_of(R"(5" pan;1)"), ';');
  EXPECT_EQ(csv_cell("pan"), "pan");
  EXPECT_EQ(csv_cell("pan, left"), R"("pan, left")");
  EXPECT_EQ(csv_cell(R"(5" pan)"), R"("5"" pan")");
  EXPECT_EQ(csv_cell("=lift"), R"("=lift")");
}

TEST(Cells, ReadBackAnyNameThatIsWritten) {
  const std::vector<std::string> names{"pan, left", R"(5" pan)", R"("pan")",  R"(a", "b)",
                                       R"(a"",b)",  R"(")",      "=lift",     "+1 pan",
                                       "-pan",      "@pan",      "pan; lift", "pan"};
  std::string header = "time";
  for (const std::string& name : names) {
    header += ',' + csv_cell(name);
  }
  std::vector<std::string> expected{"time"};
  expected.insert(expected.end(), names.begin(), names.end());
  EXPECT_EQ(separator_of(header), ',');
  EXPECT_EQ(cell_names(header, ','), expected);
  EXPECT_EQ(cell_names("time, \" pan \" ,lift\"\r", ','),
            (std::vector<std::string>{"time", "pan", "lift"}));
}

}  // namespace
}  // namespace handway::geometric
