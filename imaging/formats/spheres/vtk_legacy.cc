// VTK's legacy format, ASCII and binary (big-endian), versions 2 to 5.1.
#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

#include "base/error.h"
#include "imaging/formats/spheres/sphere_formats.h"
#include "imaging/formats/spheres/text_cursor.h"
#include "imaging/formats/spheres/vtk_types.h"

namespace talus::imaging {
namespace {

class LegacyReader {
 public:
  LegacyReader(std::string_view text, const std::string& file) : cursor_(text, file) {}

  PointCloud Read() {
    ReadHead();
    for (std::string word = Keyword(); !word.empty(); word = Keyword()) ReadSection(word);
    if (!has_points_) cursor_.Fail("has no POINTS; a data set of points is expected");
    return std::move(cloud_);
  }

 private:
  void ReadHead() {
    cursor_.Line();  // "# vtk DataFile Version 3.0"
    cursor_.Line();  // a title, any text
    const std::string kind = Keyword();
    if (kind != "ASCII" && kind != "BINARY") cursor_.Fail("must say ASCII or BINARY here");
    binary_ = kind == "BINARY";
  }

  std::string Keyword() {
    std::string word(cursor_.Word());
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return word;
  }

  void ReadSection(const std::string& word) {
    if (word == "DATASET") {
      cursor_.Line();
    } else if (word == "POINTS") {
      ReadPoints();
    } else if (word == "POINT_DATA" || word == "CELL_DATA") {
      in_point_data_ = word == "POINT_DATA";
      num_tuples_ = cursor_.Count();
    } else if (word == "METADATA") {
      SkipMetadata();
    } else if (word == "FIELD") {
      ReadField();
    } else if (word == "CELL_TYPES") {
      Values("int", cursor_.Count());
    } else if (!ReadCells(word) && !ReadAttribute(word)) {
      cursor_.Fail("\"" + word.substr(0, 40) +
                   "\" is not known here; is the file cut off or damaged?");
    }
  }

  void ReadPoints() {
    const std::size_t count = cursor_.Count();
    const std::string type(cursor_.Word());
    cloud_.points = Values(type, Product(3, count));
    has_points_ = true;
  }

  // Up to the empty line that ends it.
  void SkipMetadata() {
    cursor_.Line();
    while (!cursor_.AtEnd() && !Trimmed(cursor_.Line()).empty()) {
    }
  }

  // Version 5 writes offsets and connectivity, each with its type; before, it was one list.
  bool ReadCells(const std::string& word) {
    if (word != "CELLS" && word != "VERTICES" && word != "LINES" && word != "POLYGONS" &&
        word != "TRIANGLE_STRIPS") {
      return false;
    }
    const std::size_t num_offsets = cursor_.Count();
    const std::size_t size = cursor_.Count();
    const std::size_t start = cursor_.position();
    if (Keyword() == "OFFSETS") {
      const std::string type(cursor_.Word());
      Values(type, num_offsets);
      Keyword();  // CONNECTIVITY
      const std::string ids(cursor_.Word());
      Values(ids, size);
    } else {
      cursor_.Seek(start);
      Values("int", size);
    }
    return true;
  }

  bool ReadAttribute(const std::string& word) {
    if (word == "SCALARS") {
      ReadScalars();
    } else if (word == "VECTORS" || word == "NORMALS") {
      SkipTuples(3);
    } else if (word == "TENSORS" || word == "TENSORS6") {
      SkipTuples(word == "TENSORS" ? 9 : 6);
    } else if (word == "GLOBAL_IDS" || word == "PEDIGREE_IDS") {
      SkipTuples(1);
    } else if (word == "TEXTURE_COORDINATES") {
      cursor_.Word();
      const std::size_t components = cursor_.Count();
      const std::string type(cursor_.Word());
      Values(type, Product(components, num_tuples_));
    } else if (word == "COLOR_SCALARS" || word == "LOOKUP_TABLE") {
      ReadColors(word == "LOOKUP_TABLE");
    } else {
      return false;
    }
    return true;
  }

  void ReadScalars() {
    const std::string name(cursor_.Word());
    const auto words = Words(cursor_.Line());  // "float" or "float 1"
    double components = 1;
    if (words.empty() || (words.size() > 1 && !ParseNumber(words[1], components)) ||
        !(components >= 1 && components <= 4)) {
      cursor_.Fail("SCALARS must be followed by a name, a type and a count from 1 to 4");
    }
    const std::size_t start = cursor_.position();
    if (Keyword() == "LOOKUP_TABLE") {
      cursor_.Line();
    } else {
      cursor_.Seek(start);
    }
    const auto width = static_cast<std::size_t>(components);
    Keep(name, width, num_tuples_,
         ValuesFromHere(std::string(words[0]), Product(width, num_tuples_)));
  }

  void SkipTuples(std::size_t components) {
    cursor_.Word();
    const std::string type(cursor_.Word());
    Values(type, Product(components, num_tuples_));
  }

  // Colours are bytes in a binary file and numbers from 0 to 1 in an ASCII one.
  void ReadColors(bool table) {
    cursor_.Word();
    const std::size_t count = cursor_.Count();
    Values(binary_ ? "unsigned_char" : "float",
           table ? Product(4, count) : Product(count, num_tuples_));
  }

  // Arrays by name: of the whole file before POINT_DATA, of points or cells after it.
  void ReadField() {
    cursor_.Word();
    const std::size_t num_arrays = cursor_.Count();
    for (std::size_t a = 0; a < num_arrays; ++a) {
      std::string name(cursor_.Word());
      if (name == "METADATA") {  // of the array before
        SkipMetadata();
        name = cursor_.Word();
      }
      const std::size_t components = cursor_.Count();
      const std::size_t tuples = cursor_.Count();
      const std::string type(cursor_.Word());
      if (type == "string") cursor_.Fail("field " + name + " holds texts, which are not read");
      Keep(name, components, tuples, Values(type, Product(components, tuples)));
    }
  }

  void Keep(const std::string& name, std::size_t components, std::size_t tuples,
            std::vector<double> values) {
    if (!in_point_data_ || components != 1) return;
    if (tuples != cloud_.points.size() / 3) {
      cursor_.Fail(name + " has " + std::to_string(tuples) + " values for " +
                   std::to_string(cloud_.points.size() / 3) + " points");
    }
    cloud_.arrays.push_back({name, std::move(values)});
  }

  std::size_t Product(std::size_t a, std::size_t b) const {
    std::size_t product = 0;
    if (__builtin_mul_overflow(a, b, &product)) cursor_.Fail("names more values than it can hold");
    return product;
  }

  std::vector<double> Values(const std::string& type, std::size_t count) {
    // The bytes start after the end of the line that names them.
    if (binary_) cursor_.Line();
    return ValuesFromHere(type, count);
  }

  std::vector<double> ValuesFromHere(const std::string& type, std::size_t count) {
    const std::optional<VtkType> known = VtkTypeOf(type);
    if (!known) cursor_.Fail("\"" + type.substr(0, 40) + "\" is not a type of VTK that is read");
    if (count > cursor_.Left())
      cursor_.Fail(
          "the file ends too early for what it names; was it cut off while it was written?");
    if (binary_) {
      return Decode(*known, cursor_.Bytes(count * SizeOf(*known)), std::endian::big);
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(cursor_.Number());
    return values;
  }

  TextCursor cursor_;
  PointCloud cloud_;
  bool binary_ = false;
  bool has_points_ = false;
  bool in_point_data_ = false;
  std::size_t num_tuples_ = 0;
};

}  // namespace

PointCloud ReadVtkLegacy(std::string_view text, const std::string& file) {
  return LegacyReader(text, file).Read();
}

}  // namespace talus::imaging
