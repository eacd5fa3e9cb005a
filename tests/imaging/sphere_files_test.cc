#include "imaging/formats/spheres/sphere_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "base/error.h"
#include "base/files/file.h"
#include "base/random.h"
#include "tests/error_in.h"
#include "tests/peak_memory.h"

namespace talus::imaging {
namespace sphere_files_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class SphereFilesTest : public ::testing::Test {
 protected:
  SphereFilesTest() : folder_(fs::temp_directory_path() / ("spheres" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~SphereFilesTest() override { fs::remove_all(folder_); }

  fs::path Write(const std::string& name, std::string_view text) {
    fs::remove(folder_ / name);  // some file systems sync a file that is written over
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::vector<base::Sphere> Read(std::string_view text, const SphereFileOptions& options = {},
                                 const std::string& name = "heap.txt") {
    return ReadSpheres(Write(name, text), options);
  }
  std::string ErrorOf(std::string_view text, const SphereFileOptions& options = {}) {
    return ErrorIn([&] { Read(text, options); });
  }

  fs::path folder_;
};

// The two spheres that every good file of this test holds; exact, as decimals of few digits are
// read and scaled by powers of ten: a last-bit difference is allowed by EXPECT_DOUBLE_EQ.
void ExpectTheTwo(const std::vector<base::Sphere>& spheres) {
  ASSERT_EQ(spheres.size(), 2u);
  EXPECT_DOUBLE_EQ(spheres[0].position.x, 1e-3);
  EXPECT_DOUBLE_EQ(spheres[0].position.y, -2e-3);
  EXPECT_DOUBLE_EQ(spheres[0].position.z, 3e-3);
  EXPECT_DOUBLE_EQ(spheres[0].radius, 5e-4);
  EXPECT_DOUBLE_EQ(spheres[1].position.x, 0);
  EXPECT_DOUBLE_EQ(spheres[1].position.y, 1e-3);
  EXPECT_DOUBLE_EQ(spheres[1].position.z, 2e-3);
  EXPECT_DOUBLE_EQ(spheres[1].radius, 2.5e-4);
}

TEST_F(SphereFilesTest, CsvColumnsAreFoundByNameUnitAndSeparator) {
  ExpectTheTwo(Read("x,y,z,r\n1e-3,-2e-3,3e-3,5e-4\n0,1e-3,2e-3,2.5e-4\n"));
  ExpectTheTwo(Read("id;x_mm;y_mm;z_mm;diameter_um\r\n7;1;-2;3;1000\r\n\r\n8;0;1;2;500\r\n"));
  ExpectTheTwo(Read("# x y z radius\n1 -2 3 0.5\n0 1 2 .25\n", {.length_unit = 1e-3}));
  ExpectTheTwo(Read("#format x_y_z_r\n1e-3\t-2e-3\t3e-3\t5e-4\n0\t1e-3\t2e-3\t2.5e-4\t\n"));
  ExpectTheTwo(
      Read("\"Diameter\",\"name\",\"Points:0\",\"Points:1\",\"Points:2\"\n"
           "1e-3,a,1e-3,-2e-3,3e-3\n5e-4,b,0,1e-3,2e-3\n"));
  ExpectTheTwo(Read("x [mm],y [mm],z [mm],d (mm)\n1,-2,3,1\n0,1,2,0.5\n", {.length_unit = 7}));
}

TEST_F(SphereFilesTest, CsvQuotesHoldSeparatorsAndMustClose) {
  ExpectTheTwo(
      Read("\xef\xbb\xbf\"name, long\",x,y,z,r\n\"a, b\",1e-3,-2e-3,3e-3,5e-4\n"
           "\"c\",0,1e-3,2e-3,2.5e-4\n"));
  EXPECT_THAT(ErrorOf("name,x,y,z,r\n\"a,0,0,0,1\n"), HasSubstr("quote that is not closed"));
  EXPECT_THAT(ErrorOf("\"x,y,z,r\n0,0,0,1\n"), HasSubstr("quote that is not closed"));
}

// The first was taken in silence.
TEST_F(SphereFilesTest, TwoColumnsOfOneNameAreRefused) {
  EXPECT_THAT(ErrorOf("x,y,z,r,x\n0,0,0,1,5\n"), HasSubstr("two columns called x"));
}

TEST_F(SphereFilesTest, RadiusIsPreferredToDiameter) {
  const auto spheres = Read("d,x,y,z,r\n1,0,0,0,3\n");
  EXPECT_EQ(spheres.at(0).radius, 3);
}

constexpr const char* kDump =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n0 4\n"
    "ITEM: ATOMS id x y z radius\n1 9 9 9 9\n"
    "ITEM: TIMESTEP\n200\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n0 4\n"
    "ITEM: ATOMS id x y z vx radius \n1 1e-3 -2e-3 3e-3 0 5e-4\n2 0 1e-3 2e-3 0 2.5e-4\n";

TEST_F(SphereFilesTest, DumpGivesItsLastOrTheChosenFrame) {
  ExpectTheTwo(Read(kDump));
  EXPECT_EQ(Read(kDump, {.timestep = 0}).at(0).radius, 9);
  EXPECT_THAT(ErrorOf(kDump, {.timestep = 100}), HasSubstr("has no step 100; it has 0 200"));
}

TEST_F(SphereFilesTest, DumpInItsOwnUnitsAndScaledToItsBoxIsReadInMetres) {
  // x = -0.5 + 0.6 × 1 = 0.1 cm; y = -1 + 0.4 × 2 = -0.2 cm; z = 0.3 cm
  const std::string dump =
      "ITEM: UNITS\ncgs\nITEM: TIME\n0.25\nITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n2\n"
      "ITEM: BOX BOUNDS pp pp ff\n-0.5 0.5\n-1 1\n0 1\nITEM: ATOMS xs ys zsu diameter\n"
      "0.6 0.4 0.3 0.1\n0.5 0.55 0.2 0.05\n";
  const auto spheres = Read(dump);
  ASSERT_EQ(spheres.size(), 2u);
  // Differences of numbers near 1 lose no more than a few last bits.
  EXPECT_NEAR(spheres[0].position.x, 1e-3, 1e-17);
  EXPECT_NEAR(spheres[0].position.y, -2e-3, 1e-17);
  EXPECT_DOUBLE_EQ(spheres[0].radius, 5e-4);
  EXPECT_NEAR(Read(dump, {.length_unit = 1}).at(0).position.z, 0.3, 1e-15);
  // Both kinds of coordinates: those that need no box.
  EXPECT_EQ(
      Read("ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n"
           "0 1\nITEM: ATOMS x y z xs ys zs radius\n0.1 0.2 0.3 0.7 0.8 0.9 0.01\n")
          .at(0)
          .position,
      (base::Vec3{0.1, 0.2, 0.3}));
}

TEST_F(SphereFilesTest, VtkLegacyOfLiggghtsPostProcessorIsRead) {
  ExpectTheTwo(
      Read("# vtk DataFile Version 2.0\nGenerated by lpp\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n"
           "1e-3 -2e-3 3e-3\n0 1e-3 2e-3\nVERTICES 2 4\n1 0\n1 1\nPOINT_DATA 2\n"
           "VECTORS v float\n0 0 0\n0 0 0\nSCALARS type int 1\nLOOKUP_TABLE default\n1\n1\n"
           "SCALARS radius float\nLOOKUP_TABLE default\n5e-4\n2.5e-4\n"));
}

std::string BigEndian(std::initializer_list<double> values) {
  std::string bytes;
  for (const double value : values) {
    char raw[8];
    std::memcpy(raw, &value, 8);
    bytes.append(std::reverse_iterator(raw + 8), std::reverse_iterator(raw));
  }
  return bytes;
}

TEST_F(SphereFilesTest, VtkLegacyBinaryIsBigEndian) {
  ExpectTheTwo(Read(
      "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS 2 double\n" +
      BigEndian({1e-3, -2e-3, 3e-3, 0, 1e-3, 2e-3}) +
      "\nPOINT_DATA 2\nFIELD FieldData 1\nradius 1 2 double\n" + BigEndian({5e-4, 2.5e-4}) + "\n"));
}

std::string BigEndianFloats(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) {
    char raw[4];
    std::memcpy(raw, &value, 4);
    bytes.append(std::reverse_iterator(raw + 4), std::reverse_iterator(raw));
  }
  return bytes;
}

// Their first values went up to the next byte of ten, and with them the whole file.
TEST_F(SphereFilesTest, VtkLegacyBinaryScalarsStartAfterTheirLine) {
  const std::string head =
      "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 2 double\n" +
      BigEndian({1e-3, -2e-3, 3e-3, 0, 1e-3, 2e-3}) + "\nPOINT_DATA 2\n";
  const std::string types = "SCALARS type double 1\nLOOKUP_TABLE default\n" + BigEndian({1, 2});
  for (const char* table : {"", "LOOKUP_TABLE default\n"}) {
    for (const char* width : {"", " 1"}) {
      ExpectTheTwo(Read(head + types + "\nSCALARS radius double" + width + "\n" + table +
                        BigEndian({5e-4, 2.5e-4}) + "\n"));
    }
    const auto floats = Read(head + types + "\nSCALARS radius float 1\n" + table +
                             BigEndianFloats({0x1p-10f, 0x1.4p-11f}) + "\n");
    ASSERT_EQ(floats.size(), 2u);
    EXPECT_EQ(floats[0].radius, 0x1p-10);
    EXPECT_EQ(floats[1].radius, 0x1.4p-11);
  }
}

constexpr const char* kVtuHead =
    "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\">"
    "<UnstructuredGrid><Piece NumberOfPoints=\"2\" NumberOfCells=\"0\"><PointData>"
    "<DataArray type=\"Float32\" Name=\"Velocity\" NumberOfComponents=\"3\" format=\"ascii\">"
    "0 0 0 0 0 0</DataArray>";
constexpr const char* kVtuTail =
    "</PointData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
    "1e-3 -2e-3 3e-3 0 1e-3 2e-3</DataArray></Points></Piece></UnstructuredGrid></VTKFile>";

std::string Vtu(const std::string& array) { return kVtuHead + array + kVtuTail; }

TEST_F(SphereFilesTest, XmlIsReadWithTheNamesOfEachCode) {
  for (const char* name : {"Diameter", "diameter", "diameter_m"}) {
    ExpectTheTwo(Read(Vtu(std::string("<DataArray type=\"Float64\" Name=\"") + name +
                          "\" format=\"ascii\">1e-3 5e-4</DataArray>")));
  }
  for (const char* name : {"radius", "radii", "Radius"}) {
    ExpectTheTwo(Read(Vtu(std::string("<DataArray type=\"Float64\" Name=\"") + name +
                          "\" format=\"ascii\">5e-4 2.5e-4</DataArray>")));
  }
}

TEST_F(SphereFilesTest, Base64IsReadWithItsCountApartOrInOne) {
  // 16, 0, 0, 0 and the doubles 2^-10 and 2^-11, as VTK writes them and as meshio does
  for (const char* text : {"EAAAAA==AAAAAAAAUD8AAAAAAABAPw==", "EAAAAAAAAAAAAFA/AAAAAAAAQD8="}) {
    const auto spheres =
        Read(Vtu(std::string("<DataArray type=\"Float64\" Name=\"r\" format=\"binary\">\n  ") +
                 text + "\n</DataArray>"));
    ASSERT_EQ(spheres.size(), 2u);
    EXPECT_EQ(spheres[0].radius, 0x1p-10);
    EXPECT_EQ(spheres[1].radius, 0x1p-11);
  }
}

TEST_F(SphereFilesTest, PartsOfAParallelFileArePutTogether) {
  const std::string part =
      Vtu("<DataArray type=\"Float64\" Name=\"Diameter\" format=\"ascii\">1e-3 5e-4</DataArray>");
  Write("a.vtu", part);
  Write("b.vtu", part);
  const auto read = [&](const std::string& second) {
    return Read(
        "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"a.vtu\"/>"
        "<Piece Source=\"" +
            second + "\"/></PUnstructuredGrid></VTKFile>",
        {}, "all.pvtu");
  };
  EXPECT_EQ(read("b.vtu").size(), 4u);
  EXPECT_THROW(read("all.pvtu"), base::ConfigError);  // it would never end
  EXPECT_THROW(read("absent.vtu"), base::ConfigError);
}

// Each was bounded by itself only, and could be named a million times.
TEST_F(SphereFilesTest, PartsOfAParallelFileAreBoundedTogether) {
  fs::resize_file(Write("hole.vtu", "x"), std::uintmax_t{3} << 30);  // takes no room on the disk
  const std::string piece = "<Piece Source=\"hole.vtu\"/>";
  EXPECT_THAT(ErrorOf("<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>" + piece + piece +
                      "</PUnstructuredGrid></VTKFile>"),
              HasSubstr("more than 4096 MiB together"));
}

TEST_F(SphereFilesTest, EmptyHeapIsAListOfNone) {
  EXPECT_TRUE(Read("x,y,z,r\n").empty());
  EXPECT_TRUE(Read("<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"0\"/>"
                   "</PolyData></VTKFile>")
                  .empty());
}

TEST_F(SphereFilesTest, ErrorsSayWhatIsWrongAndWhere) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("is empty"));
  EXPECT_THAT(ErrorOf(std::string("\x89PNG\r\n\0\0", 8)), HasSubstr("is neither text nor VTK"));
  EXPECT_THAT(ErrorOf("x,y,z\n1,2,3\n"), HasSubstr("has no radius or diameter among its columns"));
  EXPECT_THAT(ErrorOf("1,2,3,4\n"), HasSubstr("the first line must name the columns"));
  EXPECT_THAT(ErrorOf("x,y,z,r\n1,2,3,4\n1,2,3\n"), HasSubstr("heap.txt:3: has 3 values"));
  EXPECT_THAT(ErrorOf("x,y,z,r\n1,2,3,4\n1,2,oops,4\n"), HasSubstr("sphere 2 has a position"));
  EXPECT_THAT(ErrorOf("x;y;z;r\n1;2;3;4\n1,5;2;3;4\n"),
              HasSubstr("heap.txt:3: has a decimal comma (1,5)"));
  EXPECT_THAT(Read("x;y;z;r;layer\n1;2;3;4;1,5\n").size(), 1u);  // a column that nobody reads
  EXPECT_THAT(ErrorOf("x,y,z,r\n1,2,3,-4\n"), HasSubstr("a radius that is not positive"));
  EXPECT_THAT(ErrorOf(std::string(kDump).substr(0, std::strlen(kDump) - 25)),
              HasSubstr("step 200 ends after 1 of 2 atoms"));
  for (const char* head :
       {"ITEM: TIMESTEP\n300\n", "ITEM: TIMESTEP\n300\nITEM: NUMBER OF ATOMS\n2\n",
        "ITEM: TIMESTEP\n300\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff "
        "ff\n0 1\n0 1\n0 1\n"}) {
    EXPECT_THAT(ErrorOf(kDump + std::string(head)), HasSubstr("a frame ends in its head")) << head;
  }
  EXPECT_THAT(ErrorOf("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n99999999\n"),
              HasSubstr("more than the file holds"));
  EXPECT_THAT(
      ErrorOf("# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n1 2"),
      HasSubstr("ends too early"));
  EXPECT_THAT(ErrorOf(Vtu("").substr(0, 300)), HasSubstr("is not complete XML"));
  EXPECT_THAT(ErrorOf("<VTKFile type=\"ImageData\"></VTKFile>"), HasSubstr("ImageData"));
  EXPECT_THAT(ErrorOf("<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"/>"),
              HasSubstr("only vtkZLibDataCompressor is read"));
  EXPECT_THAT(ErrorOf(Vtu("<DataArray type=\"Float64\" Name=\"r\" format=\"binary\">EAAA"
                          "</DataArray>")),
              HasSubstr("r ends too early"));
  EXPECT_THAT(ErrorOf(Vtu("<DataArray type=\"Float64\" Name=\"r\" format=\"ascii\">1</DataArray>")),
              HasSubstr("r has 1 values, not 2"));
}

// 700 bytes took 2 GiB: the block sizes became memory before the data was looked at.
TEST_F(SphereFilesTest, BlockSizesOfACompressedFileMustFitItsBytes) {
  // One block of 0x7fffffff bytes that takes 8 compressed, in base64.
  const std::string file =
      "<VTKFile type=\"PolyData\" compressor=\"vtkZLibDataCompressor\"><PolyData>"
      "<Piece NumberOfPoints=\"2\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"binary\">AQAAAP///38AAAAACAAAAAAAAAAAAAAA</DataArray></Points></Piece>"
      "</PolyData></VTKFile>";
  const long before = PeakMegabytes();
  EXPECT_THAT(ErrorOf(file), HasSubstr("damaged block sizes"));
  EXPECT_LT(PeakMegabytes() - before, 50);
}

// Undefined behaviour, which the sanitizer reports.
TEST_F(SphereFilesTest, HugeTimeStepIsAnError) {
  for (const char* step : {"1e300", "nan", "-1e19"}) {
    EXPECT_THAT(ErrorOf("ITEM: TIMESTEP\n" + std::string(step) + "\nITEM: NUMBER OF ATOMS\n0\n"),
                HasSubstr("heap.txt:2: this is no number of a time step"));
  }
}

// 1e400 was read as 0, a place in the middle of the heap.
TEST_F(SphereFilesTest, NumbersBeyondDoubleAreNoZeros) {
  EXPECT_THAT(ErrorOf("x,y,z,r\n1e400,2,3,4\n"), HasSubstr("sphere 1 has a position"));
  EXPECT_THAT(ErrorOf("x,y,z,r\n" + std::string(400, '9') + ",2,3,4\n"),
              HasSubstr("sphere 1 has a position"));
  EXPECT_EQ(Read("x,y,z,r\n1e-400,2,3,4\n").at(0).position.x, 0);
  EXPECT_EQ(Read("x,y,z,r\n0." + std::string(400, '0') + "1,2,3,4\n").at(0).position.x, 0);
}

// A damaged file is an error or is read as something else, but never a crash, a hang or gigabytes.
TEST_F(SphereFilesTest, DamagedFilesAreSurvived) {
  const std::string good[] = {
      "x,y,z,r\n1e-3,-2e-3,3e-3,5e-4\n0,1e-3,2e-3,2.5e-4\n", kDump,
      "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 2 double\n" +
          BigEndian({1e-3, -2e-3, 3e-3, 0, 1e-3, 2e-3}) + "\nVERTICES 1 3\n" +
          std::string(12, '\1') +
          "\nPOINT_DATA 2\nSCALARS radius double 1\nLOOKUP_TABLE default\n" +
          BigEndian({5e-4, 2.5e-4}) + "\nMETADATA\nINFORMATION 0\n\n",
      Vtu("<DataArray type=\"Float64\" Name=\"r\" format=\"binary\">EAAAAA=="
          "AAAAAAAAUD8AAAAAAABAPw==</DataArray>")};
  base::Random random(1, base::Stream("damage"));
  int num_errors = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = good[round % 4];
    for (std::uint64_t change = random.Below(4) + 1; change > 0; --change) {
      const std::size_t place = random.Below(text.size());
      if (random.Below(4) == 0) text.resize(place + 1);
      text[std::min(place, text.size() - 1)] = static_cast<char>(random.Below(256));
    }
    num_errors += ErrorOf(text).empty() ? 0 : 1;
  }
  EXPECT_GT(num_errors, 1000);  // most damage is noticed; a digit changed into another cannot be
}

// Writes files with VTK itself, in each of its encodings, and reads them back.
TEST_F(SphereFilesTest, FilesOfVtkItselfAreReadBack) {
  // Debian's interpreter, which sees Debian's modules, whatever else is first on the PATH.
  const std::string python = "/usr/bin/python3 ";
  if (std::system((python + "-c 'import vtkmodules.vtkIOXML' 2>/dev/null").c_str()) != 0) {
    GTEST_SKIP() << "python3-vtk9 is not installed";
  }
  const std::string script = TALUS_SOURCE_DIR "/tests/imaging/write_spheres_with_vtk.py";
  ASSERT_EQ(std::system((python + script + " " + folder_.string()).c_str()), 0);
  const auto expected = ReadSpheres(folder_ / "expected.csv");
  ASSERT_EQ(expected.size(), 5000u);
  int num_files = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().filename() == "expected.csv") continue;
    SCOPED_TRACE(entry.path().string());
    const auto spheres = ReadSpheres(entry.path());
    ASSERT_EQ(spheres.size(), expected.size());
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      // ASCII files of VTK carry fewer digits than a double has.
      ASSERT_NEAR(Norm(spheres[i].position - expected[i].position), 0, 1e-9);
      ASSERT_NEAR(spheres[i].radius, expected[i].radius, 1e-9);
    }
    ++num_files;
  }
  EXPECT_EQ(num_files, 20);
}

}  // namespace sphere_files_test
}  // namespace talus::imaging
