// The report's colours, in one place: the page takes them as properties of its style sheet (on
// paper and in the light look) and with its data.
#pragma once

#include <array>
#include <string>

namespace talus::analysis {

inline constexpr const char* kInk = "#1d2730";   // axes, text, lines
inline constexpr const char* kSoft = "#55626d";  // what stands back
inline constexpr const char* kStar = "#c1121f";  // the recommended set
inline constexpr const char* kAccentPale = "#d5e6ef";
inline constexpr const char* kScatterBand = "#9fb3c0";  // of one simulation

// Joint regions of a posterior.
inline constexpr const char* kRegion50 = "#2b7ba8";
inline constexpr const char* kRegion90 = "#b5d3e4";

// Okabe and Ito's colours: told apart with every common colour blindness.
inline constexpr std::array kPalette{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                     "#E69F00", "#56B4E9", "#6b6b6b"};

inline const char* PaletteColor(std::size_t index) { return kPalette[index % kPalette.size()]; }

// For the style sheet, ahead of what it says of a dark screen.
std::string ColorProperties();

}  // namespace talus::analysis
