#include "imaging/formats/spheres/vtk_xml_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/error.h"
#include "imaging/formats/spheres/text_cursor.h"

namespace talus::imaging {
namespace {

constexpr std::size_t kMaxBlock = std::size_t{1} << 31;  // VTK's blocks are 32 KiB
constexpr std::size_t kMostInflated = 1032;              // bytes that deflate makes of one [zlib]

// Bytes one after another, from raw or base64 text. Base64 is read in groups of four, each of which
// may be padded: VTK encodes the counts and the data as two texts, others as one.
class ByteStream {
 public:
  ByteStream(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  std::string Take(std::size_t count) {
    // Four characters of base64 are at most three bytes.
    if (count > (text_.size() - position_) + spare_.size()) Short();
    if (!base64_) {
      position_ += count;
      return std::string(text_.substr(position_ - count, count));
    }
    std::string bytes = std::move(spare_);
    bytes.reserve(count + 3);
    while (bytes.size() < count) TakeGroup(bytes);
    spare_ = bytes.substr(count);
    bytes.resize(count);
    return bytes;
  }

 private:
  [[noreturn]] static void Short() {
    throw base::Error("ends too early; was the file cut off while it was written?");
  }

  static int Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
  }

  char NextCharacter() {
    while (position_ < text_.size() && Trimmed(text_.substr(position_, 1)).empty()) ++position_;
    if (position_ >= text_.size()) Short();
    return text_[position_++];
  }

  void TakeGroup(std::string& bytes) {
    std::uint32_t bits = 0;
    int padding = 0;
    for (int i = 0; i < 4; ++i) {
      const char c = NextCharacter();
      const int digit = c == '=' ? 0 : Digit(c);
      if (digit < 0 || (c != '=' && padding > 0)) throw base::Error("is not base64");
      padding += c == '=' ? 1 : 0;
      bits = bits << 6 | static_cast<std::uint32_t>(digit);
    }
    if (padding > 2) throw base::Error("is not base64");
    for (int i = 0; i < 3 - padding; ++i) bytes += static_cast<char>(bits >> (16 - 8 * i) & 0xff);
  }

  std::string_view text_;
  bool base64_;
  std::size_t position_ = 0;
  std::string spare_;  // decoded but not taken
};

std::size_t TakeCount(ByteStream& stream, const VtkEncoding& encoding) {
  const std::string bytes = stream.Take(SizeOf(encoding.header));
  const double count = Decode(encoding.header, bytes, encoding.order).at(0);
  if (!(count >= 0 && count < 1e15)) throw base::Error("has a damaged byte count");
  return static_cast<std::size_t>(count);
}

// At most `array_size` bytes. Counts: blocks, bytes of a block, bytes of the last if it is shorter
// (else 0), then each block's compressed bytes.
std::string Inflate(ByteStream& stream, const VtkEncoding& encoding, std::size_t array_size) {
  const std::size_t num_blocks = TakeCount(stream, encoding);
  const std::size_t block_size = TakeCount(stream, encoding);
  const std::size_t last_size = TakeCount(stream, encoding);
  if (block_size > kMaxBlock || last_size > block_size) {
    throw base::Error("has damaged block sizes");
  }
  std::vector<std::size_t> compressed;
  for (std::size_t b = 0; b < num_blocks; ++b) compressed.push_back(TakeCount(stream, encoding));
  std::string bytes;
  for (std::size_t b = 0; b < num_blocks; ++b) {
    const std::string packed = stream.Take(compressed[b]);
    const bool partial = b + 1 == num_blocks && last_size > 0;
    const std::size_t expected = partial ? last_size : block_size;
    // Before it becomes memory: a file of 700 bytes must not ask for 2 GiB.
    if (expected / kMostInflated > packed.size() || bytes.size() + expected > array_size) {
      throw base::Error("has damaged block sizes");
    }
    std::string block(expected, '\0');
    uLongf size = block.size();
    const int status = uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (status != Z_OK || size != block.size()) throw base::Error("has damaged compressed data");
    bytes += block;
  }
  return bytes;
}

std::vector<double> Numbers(std::string_view text) {
  std::vector<double> values;
  for (const std::string_view word : Words(text)) {
    if (!ParseNumber(word, values.emplace_back())) {
      throw base::Error("has \"" + std::string(word.substr(0, 40)) + "\", which is not a number");
    }
  }
  return values;
}

}  // namespace

std::vector<double> ReadValues(const VtkArray& array, const VtkEncoding& encoding) {
  if (array.format == "ascii") return Numbers(array.text);
  const bool appended = array.format == "appended";
  if (!appended && array.format != "binary") {
    throw base::Error("has the format \"" + array.format + "\", which is not VTK's");
  }
  if (appended && array.offset > encoding.appended.size()) {
    throw base::Error("starts beyond the end of the appended data; was the file cut off?");
  }
  ByteStream stream(appended ? encoding.appended.substr(array.offset) : Trimmed(array.text),
                    !appended || encoding.appended_base64);
  const std::string bytes = encoding.zlib
                                ? Inflate(stream, encoding, array.count * SizeOf(array.type))
                                : stream.Take(TakeCount(stream, encoding));
  return Decode(array.type, bytes, encoding.order);
}

}  // namespace talus::imaging
