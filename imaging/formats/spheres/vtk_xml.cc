// VTK's XML formats: <VTKFile> with pieces of points, or with the names of files that have them.
#include <array>
#include <pugixml.hpp>

#include "base/error.h"
#include "imaging/formats/spheres/sphere_formats.h"
#include "imaging/formats/spheres/text_cursor.h"
#include "imaging/formats/spheres/vtk_xml_data.h"

namespace talus::imaging {
namespace {

constexpr unsigned long long kMostPoints = 1ull << 32;

[[noreturn]] void Fail(const std::string& file, const std::string& what) {
  throw base::ConfigError(file + ": " + what);
}

// Raw bytes after `<AppendedData …>_` are not XML: they are cut out before it is parsed.
struct Split {
  std::string xml;
  std::string_view appended;
};

Split CutAppended(std::string_view text, const std::string& file) {
  const std::size_t element = text.find("<AppendedData");
  if (element == std::string_view::npos) return {std::string(text), {}};
  const std::size_t close = text.find('>', element);
  const std::size_t start = text.find('_', close);
  const std::size_t end = text.rfind("</AppendedData>");
  if (close == std::string_view::npos || start == std::string_view::npos) {
    Fail(file, "ends inside <AppendedData>; was it cut off while it was written?");
  }
  if (end == std::string_view::npos || end < start) {
    Fail(file, "has no </AppendedData>; was it cut off while it was written?");
  }
  return {std::string(text.substr(0, close + 1)) + std::string(text.substr(end)),
          text.substr(start + 1, end - start - 1)};
}

VtkEncoding EncodingOf(const pugi::xml_node& root, std::string_view appended,
                       const std::string& file) {
  VtkEncoding encoding;
  encoding.appended = appended;
  encoding.appended_base64 =
      root.child("AppendedData").attribute("encoding").as_string("base64") == std::string("base64");
  const std::string order = root.attribute("byte_order").as_string("LittleEndian");
  encoding.order = order == "BigEndian" ? std::endian::big : std::endian::little;
  const std::string header = root.attribute("header_type").as_string("UInt32");
  encoding.header = header == "UInt64" ? VtkType::kUInt64 : VtkType::kUInt32;
  const std::string compressor = root.attribute("compressor").as_string();
  encoding.zlib = compressor == "vtkZLibDataCompressor";
  if (!compressor.empty() && !encoding.zlib) {
    Fail(file, "is compressed by " + compressor + "; only vtkZLibDataCompressor is read");
  }
  return encoding;
}

class PieceReader {
 public:
  PieceReader(const VtkEncoding& encoding, std::string file)
      : encoding_(encoding), file_(std::move(file)) {}

  void Read(const pugi::xml_node& piece, PointCloud& cloud) const {
    const auto count = piece.attribute("NumberOfPoints").as_ullong();
    if (count > kMostPoints) Fail(file_, "says that it has " + std::to_string(count) + " points");
    const pugi::xml_node points = piece.child("Points").child("DataArray");
    if (count > 0 && !points) Fail(file_, "has a piece without <Points>");
    if (points) Append(ValuesOf(points, 3 * count), cloud.points);
    std::size_t index = 0;
    for (const pugi::xml_node& node : piece.child("PointData").children("DataArray")) {
      if (node.attribute("NumberOfComponents").as_int(1) != 1) continue;
      if (!VtkTypeOf(node.attribute("type").as_string())) continue;  // texts
      const std::string name = node.attribute("Name").as_string();
      if (cloud.arrays.size() <= index) cloud.arrays.push_back({name, {}});
      if (cloud.arrays[index].name != name) Fail(file_, "has pieces with different arrays");
      Append(ValuesOf(node, count), cloud.arrays[index++].values);
    }
    for (const PointCloud::Array& array : cloud.arrays) {
      if (array.values.size() == cloud.points.size() / 3) continue;
      Fail(file_, "has pieces with different arrays: " + array.name + " is not in all");
    }
  }

 private:
  static void Append(const std::vector<double>& values, std::vector<double>& to) {
    to.insert(to.end(), values.begin(), values.end());
  }

  std::vector<double> ValuesOf(const pugi::xml_node& node, unsigned long long count) const {
    const std::string name = node.attribute("Name").as_string("Points");
    const std::string type = node.attribute("type").as_string();
    const std::optional<VtkType> known = VtkTypeOf(type);
    if (!known) Fail(file_, name + " has the type \"" + type + "\", which is not a number");
    try {
      std::vector<double> values =
          ReadValues({.name = name,
                      .format = node.attribute("format").as_string("ascii"),
                      .type = *known,
                      .text = node.text().get(),
                      .offset = node.attribute("offset").as_ullong(),
                      .count = count},
                     encoding_);
      if (values.size() == count) return values;
      throw base::Error("has " + std::to_string(values.size()) + " values, not " +
                        std::to_string(count));
    } catch (const base::Error& error) {
      Fail(file_, name + " " + error.what());
    }
  }

  const VtkEncoding& encoding_;
  std::string file_;
};

}  // namespace

VtkXml ReadVtkXml(std::string_view text, const std::string& file) {
  const Split split = CutAppended(text, file);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(split.xml.data(), split.xml.size(), pugi::parse_default);
  if (!parsed) {
    Fail(file, std::string("is not complete XML (") + parsed.description() + " at byte " +
                   std::to_string(parsed.offset) + "); was it cut off while it was written?");
  }
  const pugi::xml_node root = document.child("VTKFile");
  const std::string type = root.attribute("type").as_string();
  const pugi::xml_node data = root.child(type.c_str());
  VtkXml result;
  if (type == "PPolyData" || type == "PUnstructuredGrid") {
    for (const pugi::xml_node& piece : data.children("Piece")) {
      result.parts.emplace_back(piece.attribute("Source").as_string());
    }
    return result;
  }
  if (type != "PolyData" && type != "UnstructuredGrid") {
    Fail(file, "holds \"" + type + "\"; PolyData or UnstructuredGrid is expected");
  }
  const VtkEncoding encoding = EncodingOf(root, split.appended, file);
  const PieceReader reader(encoding, file);
  for (const pugi::xml_node& piece : data.children("Piece")) reader.Read(piece, result.cloud);
  return result;
}

}  // namespace talus::imaging
