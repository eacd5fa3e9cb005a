// Text dumps of LIGGGHTS and LAMMPS (dump custom, write_dump): frames of `ITEM:` sections.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/not_known.h"
#include "imaging/formats/spheres/sphere_formats.h"
#include "imaging/formats/spheres/text_cursor.h"

namespace talus::imaging {
namespace {

struct Axis {
  double low = 0;   // of the box, in file units
  double size = 0;  // ditto
};

struct DumpFrame {
  std::int64_t timestep = 0;
  std::size_t num_atoms = 0;
  bool triclinic = false;
  std::array<Axis, 3> box;
  std::optional<double> length_unit;  // [m], from `ITEM: UNITS`
  std::vector<std::string> names;
  std::size_t atoms = 0;  // where the rows start in the text
};

std::optional<double> LengthOf(std::string_view units) {
  constexpr std::pair<std::string_view, double> kStyles[] = {
      {"si", 1}, {"cgs", 1e-2}, {"micro", 1e-6}, {"nano", 1e-9}, {"metal", 1e-10}, {"real", 1e-10}};
  for (const auto& [name, meters] : kStyles) {
    if (name == units) return meters;
  }
  return std::nullopt;
}

// "1e6" and "1000000.0" are steps too; beyond 2^53 they could not be told apart.
std::int64_t TimestepOf(TextCursor& cursor) {
  constexpr double kLargest = 9007199254740992;
  const double step = cursor.Number();
  if (!(step >= -kLargest && step <= kLargest)) cursor.Fail("this is no number of a time step");
  return static_cast<std::int64_t>(step);
}

void ReadBox(TextCursor& cursor, std::string_view kind, DumpFrame& frame) {
  frame.triclinic = kind.find("xy") != std::string_view::npos;
  for (Axis& axis : frame.box) {
    axis.low = cursor.Number();
    axis.size = cursor.Number() - axis.low;
    cursor.Line();
  }
}

// Reads the head of a section into `frame`; true at `ATOMS`, after which its rows follow.
bool ReadSection(TextCursor& cursor, std::string_view section, DumpFrame& frame) {
  if (section == "TIMESTEP") {
    frame.timestep = TimestepOf(cursor);
    cursor.Line();
  } else if (section == "NUMBER OF ATOMS") {
    frame.num_atoms = cursor.Count();
    cursor.Line();
  } else if (section == "UNITS") {
    frame.length_unit = LengthOf(Trimmed(cursor.Line()));
  } else if (section.starts_with("BOX BOUNDS")) {
    ReadBox(cursor, section, frame);
  } else if (section.starts_with("ATOMS")) {
    frame.names.clear();
    for (const std::string_view name : Words(section.substr(5))) frame.names.emplace_back(name);
    return true;
  } else {  // TIME and whatever later versions add: one line
    cursor.Line();
  }
  return false;
}

// Leaves the cursor after the frame's rows; false when the text has no further frame.
bool NextFrame(TextCursor& cursor, DumpFrame& frame) {
  constexpr std::string_view kItem = "ITEM: ";
  bool begun = false;
  bool found = false;
  while (!found) {
    if (cursor.AtEnd()) {
      if (!begun) return false;
      cursor.Fail(
          "a frame ends in its head; was the simulation cut off while it wrote? Simulate again, or "
          "cut this frame away");
    }
    const std::string_view line = cursor.Line();
    if (Trimmed(line).empty()) continue;
    if (!line.starts_with(kItem)) cursor.Fail("an \"ITEM:\" line is expected here");
    begun = true;
    found = ReadSection(cursor, Trimmed(line.substr(kItem.size())), frame);
  }
  frame.atoms = cursor.position();
  for (std::size_t i = 0; i < frame.num_atoms; ++i) {
    if (cursor.AtEnd()) {
      cursor.Fail("step " + std::to_string(frame.timestep) + " ends after " + std::to_string(i) +
                  " of " + std::to_string(frame.num_atoms) +
                  " atoms; was the simulation cut off while it wrote?");
    }
    cursor.Line();
  }
  return true;
}

DumpFrame Choose(TextCursor& cursor, const SphereFileOptions& options) {
  std::optional<DumpFrame> chosen;
  std::string steps;
  DumpFrame frame;
  while (NextFrame(cursor, frame)) {
    if (!options.timestep || *options.timestep == frame.timestep) chosen = frame;
    if (steps.size() < 200) steps += " " + std::to_string(frame.timestep);
  }
  if (!chosen && options.timestep) {
    throw base::ConfigError(cursor.file() + ": has no step " + std::to_string(*options.timestep) +
                            "; it has" + (steps.empty() ? " none" : steps));
  }
  if (!chosen) cursor.Fail("has no frame with an \"ITEM: ATOMS\" section");
  return *chosen;
}

// "xs" and "xsu" are fractions of the box; their column is made "x" and unscaled row by row.
std::array<std::optional<std::size_t>, 3> ScaledColumns(DumpFrame& frame, const std::string& file) {
  std::array<std::optional<std::size_t>, 3> scaled;
  constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string plain(kAxes[axis]);
    const auto is_plain = [&](const std::string& name) {
      return name == plain || name == plain + "u";
    };
    if (std::ranges::any_of(frame.names, is_plain)) continue;  // stated twice
    for (std::size_t c = 0; c < frame.names.size(); ++c) {
      std::string& name = frame.names[c];
      if (name != plain + "s" && name != plain + "su") continue;
      if (frame.triclinic) {
        throw base::ConfigError(file + ": has scaled coordinates in a tilted box; dump x y z");
      }
      name = plain;
      scaled[axis] = c;
    }
  }
  return scaled;
}

}  // namespace

std::vector<base::Sphere> ReadDump(std::string_view text, const std::string& file,
                                   const SphereFileOptions& options) {
  TextCursor cursor(text, file);
  DumpFrame frame = Choose(cursor, options);
  const auto scaled = ScaledColumns(frame, file);
  const double unit = options.length_unit.value_or(frame.length_unit.value_or(1));
  const SphereColumns columns(frame.names, file, unit);
  std::vector<base::Sphere> spheres;
  spheres.reserve(frame.num_atoms);
  std::vector<double> row(frame.names.size());
  cursor.Seek(frame.atoms);
  for (std::size_t i = 0; i < frame.num_atoms; ++i) {
    const auto words = Words(cursor.Line());
    if (words.size() < row.size())
      cursor.Fail("this atom has too few values; is the file cut off?");
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (!ParseNumber(words[c], row[c])) row[c] = base::kNotKnown;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!scaled[axis]) continue;
      double& value = row[*scaled[axis]];
      value = frame.box[axis].low + value * frame.box[axis].size;
    }
    spheres.push_back(columns.Row(row));
  }
  return spheres;
}

}  // namespace talus::imaging
