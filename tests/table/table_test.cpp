// Tables as files, read back by others: NumPy and our own readers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "table/data_table.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

DataTable sample_table() {
  DataTable table;
  table.rows = 3;
  table.add("t", "s", {0, 0.1, 0.3});
  table.add("q", {"q1 [rad]", "q2 [m]"}, {2}, {1, 2, 1.0 / 3, 4, 5, -6e-300});
  table.add("frames", {"b.x [m]", "b.y [m]", "b.z [m]", "ß.x [m]", "ß.y [m]", "ß.z [m]"}, {2, 3},
            {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17});
  return table;
}

TEST(DataTable, IsReadByNumPyWithItsShapesNamesAndLastBits) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.npz", table_bytes(sample_table(), TableFormat::npz));
  const ProgramResult read = run_command(
      {"/usr/bin/python3", "-c",
       "import numpy, sys\n"
       "d = numpy.load(sys.argv[1])\n"  // without pickles
       "print(sorted(d.files), d['t'].shape, d['q'].shape, d['frames'].shape, d['q'].dtype)\n"
       "print(repr(float(d['q'][1, 0])), repr(float(d['q'][2, 1])), d['frames'][1, 1, 2], float(d['t'][2]))\n"
       "print(d['columns'][3], d['columns'][6], len(d['columns']))\n",
       file});
  ASSERT_EQ(read.status, 0) << read.err;
  EXPECT_EQ(read.out,
            "['columns', 'frames', 'q', 't'] (3,) (3, 2) (3, 2, 3) float64\n"
            "0.3333333333333333 -6e-300 11.0 0.3\n"
            "b.x [m] ß.x [m] 9\n");
}

TEST(DataTable, HasTheSameBytesEachTime) {
  for (const TableFormat format : {TableFormat::csv, TableFormat::json, TableFormat::npz})
    EXPECT_EQ(table_bytes(sample_table(), format), table_bytes(sample_table(), format));
}

TEST(DataTable, IsReadBackFromCsvByNamesWithoutUnits) {
  const TemporaryFolder folder;
  const Table read = read_csv(folder.write("a.csv", table_bytes(sample_table(), TableFormat::csv)));
  EXPECT_EQ(read.names, (std::vector<std::string>{"t", "q1", "q2", "b.x", "b.y", "b.z", "ß.x", "ß.y", "ß.z"}));
  EXPECT_EQ(read.columns[1][1], 1.0 / 3);
  EXPECT_EQ(read.columns[2][2], -6e-300);
  // Only what stands in brackets behind a blank is a unit.
  EXPECT_EQ(read_csv(folder.write("b.csv", "t[s],[m],q [rad] \n1,2,3\n")).names, (std::vector<std::string>{"t[s]", "[m]", "q"}));
  EXPECT_THROW(read_csv(folder.write("c.csv", "q [m],q [rad]\n1,2\n")), Error);
}

TEST(DataTable, IsNestedInJsonAsItsShapesSay) {
  const Json json = Json::parse(table_bytes(sample_table(), TableFormat::json));
  EXPECT_EQ(json["columns"][1], "q1 [rad]");
  EXPECT_EQ(json["t"], Json({0.0, 0.1, 0.3}));
  EXPECT_EQ(json["q"][0], Json({1.0, 2.0}));
  EXPECT_EQ(json["frames"][1][1], Json({9.0, 10.0, 11.0}));
}

TEST(DataTable, WithoutRowsIsStillATable) {
  DataTable table;
  table.add("t", "s", {});
  table.add("q", {"q1"}, {1}, {});
  EXPECT_EQ(table_bytes(table, TableFormat::csv), "t [s],q1\n");
  EXPECT_EQ(Json::parse(table_bytes(table, TableFormat::json))["q"], Json::array());
  const TemporaryFolder folder;
  const ProgramResult read = run_command({"/usr/bin/python3", "-c", "import numpy, sys; print(numpy.load(sys.argv[1])['q'].shape)",
                                          folder.write("a.npz", table_bytes(table, TableFormat::npz))});
  EXPECT_EQ(read.out, "(0, 1)\n") << read.err;
}

TEST(DataTable, SaysWhatIsNoNumberInTheWayOfItsFormat) {
  DataTable table;
  table.rows = 3;
  table.add("x", "", {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
  EXPECT_EQ(table_bytes(table, TableFormat::csv), "x\nnan\ninf\n-inf\n");
  EXPECT_EQ(Json::parse(table_bytes(table, TableFormat::json))["x"], Json({nullptr, nullptr, nullptr}));
}

TEST(DataTable, PutsNamesWithCommasIntoQuotes) {
  DataTable table;
  table.rows = 1;
  table.add("x", {"a,b \"c\".x [m]"}, {1}, {1});
  EXPECT_EQ(table_bytes(table, TableFormat::csv), "\"a,b \"\"c\"\".x [m]\"\n1\n");
}

TEST(TableFormat, IsKnownByItsEndingAndTellsTheKnownOnes) {
  EXPECT_EQ(table_format_of("a.b/c.npz"), TableFormat::npz);
  EXPECT_EQ(table_format_of("x.json"), TableFormat::json);
  EXPECT_EQ(table_format_of("A.CSV"), TableFormat::csv);
  EXPECT_EQ(table_format_of("a.Npz"), TableFormat::npz);
  EXPECT_EQ(table_format_of("-"), TableFormat::csv);
  for (const std::string path : {"a", "a.csv.gz", "a.CSV.GZ", "a.csv/b", ".csv", "a.xlsx"}) {
    try {
      table_format_of(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_THAT(error.problems().front().message, HasSubstr(".csv, .json, .npz")) << path;
    }
  }
}

}  // namespace
}  // namespace chainreel
