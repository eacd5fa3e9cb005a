#include "base/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/error_in.h"

namespace talus::base {
namespace units_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::array kAll{
    Dimension::kLength,        Dimension::kMass,         Dimension::kTime,
    Dimension::kVelocity,      Dimension::kAcceleration, Dimension::kAngularVelocity,
    Dimension::kAngle,         Dimension::kDensity,      Dimension::kPressure,
    Dimension::kSurfaceEnergy, Dimension::kEnergy,       Dimension::kMassRate,
    Dimension::kAreaDensity};

TEST(Units, QuantitiesAsPeopleWriteThem) {
  EXPECT_DOUBLE_EQ(ParseQuantity("45 um", Dimension::kLength), 45e-6);
  EXPECT_DOUBLE_EQ(ParseQuantity("45µm", Dimension::kLength), 45e-6);
  EXPECT_DOUBLE_EQ(ParseQuantity("10mm", Dimension::kLength), 0.01);
  EXPECT_DOUBLE_EQ(ParseQuantity("1.5 g", Dimension::kMass), 1.5e-3);
  EXPECT_DOUBLE_EQ(ParseQuantity("1 cm/s", Dimension::kVelocity), 0.01);
  EXPECT_DOUBLE_EQ(ParseQuantity("26.25 MPa", Dimension::kPressure), 26.25e6);
  EXPECT_DOUBLE_EQ(ParseQuantity("40e-5 J/m^2", Dimension::kSurfaceEnergy), 40e-5);
  EXPECT_DOUBLE_EQ(ParseQuantity("4.386 g/cm^3", Dimension::kDensity), 4386);
  EXPECT_DOUBLE_EQ(ParseQuantity("6 g/min", Dimension::kMassRate), 1e-4);
  EXPECT_DOUBLE_EQ(ParseQuantity(" 7 ", Dimension::kTime), 7);
  EXPECT_DOUBLE_EQ(ParseQuantity("30 %", Dimension::kNone), 0.3);
  EXPECT_DOUBLE_EQ(ParseQuantity("15 rpm", Dimension::kAngularVelocity), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(ParseQuantity("90 deg/s", Dimension::kAngularVelocity), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(ParseQuantity("180 deg", Dimension::kAngle), std::numbers::pi);
  EXPECT_DOUBLE_EQ(ParseQuantity("2 h", Dimension::kTime), 7200);
  EXPECT_DOUBLE_EQ(ParseQuantity("3 ms", Dimension::kTime), 3e-3);
  EXPECT_DOUBLE_EQ(ParseQuantity("20 nm", Dimension::kLength), 2e-8);
  EXPECT_DOUBLE_EQ(ParseQuantity("1 bar", Dimension::kPressure), 1e5);
  EXPECT_DOUBLE_EQ(ParseQuantity("2 kPa", Dimension::kPressure), 2e3);
  EXPECT_DOUBLE_EQ(ParseQuantity("70 GPa", Dimension::kPressure), 7e10);
  EXPECT_DOUBLE_EQ(ParseQuantity("1 N/mm^2", Dimension::kPressure), 1e6);
  EXPECT_DOUBLE_EQ(ParseQuantity("5 mN/m", Dimension::kSurfaceEnergy), 5e-3);
  EXPECT_DOUBLE_EQ(ParseQuantity("10 zJ", Dimension::kEnergy), 1e-20);
  EXPECT_DOUBLE_EQ(ParseQuantity("1 kg/L", Dimension::kDensity), 1000);
  EXPECT_DOUBLE_EQ(ParseQuantity("1 g0", Dimension::kAcceleration), 9.80665);
  EXPECT_DOUBLE_EQ(ParseQuantity("2 t", Dimension::kMass), 2000);
}

std::string ErrorOf(std::string_view text, Dimension dimension) {
  return ErrorIn([&] { ParseQuantity(text, dimension); });
}

TEST(Units, WrongOnesAreNamedWithThoseThatFit) {
  EXPECT_THAT(ErrorOf("3 kg", Dimension::kLength), HasSubstr("\"kg\", which does not fit"));
  EXPECT_THAT(ErrorOf("3 kg", Dimension::kLength), HasSubstr("\"1 mm\""));
  EXPECT_THAT(ErrorOf("", Dimension::kMass), HasSubstr("does not start with a number"));
  EXPECT_THAT(ErrorOf("nan", Dimension::kMass), HasSubstr("does not start with a number"));
  EXPECT_THAT(ErrorOf("about 3 g", Dimension::kMass), HasSubstr("does not start with a number"));
}

// Four stand in a message: those that are meant, not the SI's prefixes in order.
TEST(Units, TheUsualOnesAreNamedFirst) {
  EXPECT_THAT(ErrorOf("3 kg", Dimension::kLength), HasSubstr(R"("1 m", "1 mm", "1 um", "1 cm")"));
  EXPECT_THAT(ErrorOf("3 kg", Dimension::kTime), HasSubstr(R"("1 s", "1 min", "1 h", "1 ms")"));
  EXPECT_THAT(ErrorOf("3 kg", Dimension::kAngularVelocity),
              HasSubstr(R"("1 rad/s", "1 rpm", "1 1/min", "1 deg/s")"));
  EXPECT_THAT(ErrorOf("3 kg", Dimension::kDensity),
              HasSubstr(R"("1 kg/m^3", "1 g/cm^3", "1 g/mL", "1 g/L")"));
  EXPECT_EQ(SiUnit(Dimension::kAngularVelocity), "rad/s");
}

TEST(Units, AUnitStandsAfterItsNumber) {
  EXPECT_EQ(UnitIn(" 0.64 g/mL "), "g/mL");
  EXPECT_EQ(UnitIn("30deg"), "deg");
  EXPECT_EQ(UnitIn("1e-3"), "");
  EXPECT_EQ(UnitIn("7 "), "");
  EXPECT_EQ(UnitIn("mm"), "");
  EXPECT_EQ(UnitIn("1,602 g"), "");
  EXPECT_TRUE(IsBareNumber(" 1e-3 "));
  EXPECT_FALSE(IsBareNumber("1 g"));
  EXPECT_FALSE(IsBareNumber("g"));
}

TEST(Units, ACommaInANumberIsNamedWithWhatToWrite) {
  EXPECT_EQ(ErrorOf("1,602 g", Dimension::kMass),
            "\"1,602 g\" has a comma in its number; write \"1.602 g\" with a point, or \"1602 g\" "
            "if the comma parts thousands");
  EXPECT_THAT(ErrorOf("0,35", Dimension::kNone), HasSubstr("write \"0.35\" with a point"));
  // Only what is a number is advised: a comma of thousands stands before three digits.
  EXPECT_THAT(ErrorOf("0,5", Dimension::kNone), Not(HasSubstr("thousands")));
  EXPECT_THAT(ErrorOf("-1.450,0 kg", Dimension::kMass), HasSubstr("write \"-1450.0 kg\" without"));
  EXPECT_THAT(ErrorOf("1,450,000.5 g", Dimension::kMass), HasSubstr("write \"1450000.5 g\""));
  EXPECT_THAT(ErrorOf("0.3,5", Dimension::kNone), HasSubstr("write it with one point at most"));
  EXPECT_THAT(ErrorOf("1e3,5", Dimension::kNone), HasSubstr("write its exponent without one"));
  EXPECT_THAT(ErrorOf("4,386.5 kg/m3", Dimension::kDensity),
              HasSubstr("write \"4386.5 kg/m3\" without"));
  EXPECT_THAT(ErrorOf("3, g", Dimension::kMass), HasSubstr("does not fit here"));
}

// As people type them: powers without ^, microns, either of Unicode's two letters mu.
TEST(Units, ReadsWhatPeopleType) {
  EXPECT_DOUBLE_EQ(ParseQuantity("1500 kg/m3", Dimension::kDensity), 1500);
  EXPECT_DOUBLE_EQ(ParseQuantity("1.5 g/cm3", Dimension::kDensity), 1500);
  EXPECT_DOUBLE_EQ(ParseQuantity("1.5 g/ml", Dimension::kDensity), 1500);
  EXPECT_DOUBLE_EQ(ParseQuantity("640 g/L", Dimension::kDensity), 640);
  EXPECT_DOUBLE_EQ(ParseQuantity("640 g/l", Dimension::kDensity), 640);
  EXPECT_DOUBLE_EQ(ParseQuantity("15 1/min", Dimension::kAngularVelocity),
                   ParseQuantity("15 rpm", Dimension::kAngularVelocity));
  EXPECT_DOUBLE_EQ(ParseQuantity("80 microns", Dimension::kLength), 80e-6);
  EXPECT_DOUBLE_EQ(ParseQuantity("0.5 inch", Dimension::kLength), 12.7e-3);
  EXPECT_DOUBLE_EQ(ParseQuantity("1.6 grams", Dimension::kMass), 1.6e-3);
  EXPECT_DOUBLE_EQ(ParseQuantity("20 mm/sec", Dimension::kVelocity), 0.02);
  EXPECT_DOUBLE_EQ(ParseQuantity("3 sec", Dimension::kTime), 3);
  EXPECT_DOUBLE_EQ(ParseQuantity("10 MN/m2", Dimension::kPressure), 1e7);
  EXPECT_DOUBLE_EQ(ParseQuantity("80 \u00b5m", Dimension::kLength), 80e-6);
  EXPECT_DOUBLE_EQ(ParseQuantity("80 \u03bcm", Dimension::kLength), 80e-6);
  EXPECT_DOUBLE_EQ(ParseQuantity("2 mJ/m2", Dimension::kSurfaceEnergy), 2e-3);
  EXPECT_DOUBLE_EQ(ParseQuantity("2 \u00b5J/m\u00b2", Dimension::kSurfaceEnergy), 2e-6);
  EXPECT_DOUBLE_EQ(ParseQuantity("9.81 m/s2", Dimension::kAcceleration), 9.81);
  EXPECT_THROW(ParseQuantity("1 m2", Dimension::kLength), ConfigError);
}

// 1 g of powder on 100 cm².
TEST(Units, MassPerAreaAsItIsWeighed) {
  for (const char* text : {"0.1 kg/m2", "0.1 kg/m^2", "0.1 kg/m\u00b2", "100 g/m^2", "10 mg/cm^2",
                           "10 mg/cm2", "0.01 g/cm2", "1e5 mg/m2", "1e4 \u00b5g/cm\u00b2",
                           "100 \u03bcg/mm2", "0.1 mg/mm^2", "0.1"}) {
    EXPECT_DOUBLE_EQ(ParseQuantity(text, Dimension::kAreaDensity), 0.1) << text;
  }
  EXPECT_THAT(ErrorOf("10 mg/cm3", Dimension::kAreaDensity), HasSubstr("\"1 mg/cm^2\""));
}

// Each row of docs/units.md has the units of one dimension, its SI unit first.
TEST(Units, DocumentedOnesAreRead) {
  std::ifstream page(std::filesystem::path(TALUS_SOURCE_DIR) / "docs/units.md");
  int num_rows = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| ") || line.find('`') == std::string::npos) continue;
    std::vector<std::string> units;
    for (auto at = line.find('`'); at != std::string::npos; at = line.find('`', at + 1)) {
      const auto end = line.find('`', at + 1);
      units.push_back(line.substr(at + 1, end - at - 1));
      at = end;
    }
    if (units.front() == "%") continue;
    ++num_rows;
    const auto dimension = std::ranges::find(kAll, units.front(), SiUnit);
    ASSERT_NE(dimension, kAll.end()) << line;
    for (const std::string& unit : units) {
      EXPECT_GT(ParseQuantity("1 " + unit, *dimension), 0) << unit;
    }
  }
  EXPECT_EQ(num_rows, kAll.size());
}

}  // namespace units_test
}  // namespace talus::base
