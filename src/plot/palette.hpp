// SPDX-License-Identifier: GPL-3.0-or-later
/// The colours and type sizes of all pictures and pages: the one table of them. README.md beside this file says how they are used; the
/// page's style sheet has the same values, which a test holds against this table.
#pragma once

#include <array>
#include <string_view>

#include "earthtop/plot/plot.hpp"

namespace earthtop {

/// A colour on a light and on a dark background, and the name of the page's custom property with it.
struct Ink {
  std::string_view name, light, dark;
};

/// A curve's colour. The light ones are Okabe and Ito's, which the colour-blind can tell apart.
struct CurveInk {
  LineColor color;
  Ink ink;
};
inline constexpr std::array kCurveInks = {CurveInk{LineColor::blue, {"ref", "#0072b2", "#56b4e9"}},
                                          CurveInk{LineColor::vermillion, {"axis", "#d55e00", "#f0803c"}},
                                          CurveInk{LineColor::green, {"gravity", "#009e73", "#1fc79a"}},
                                          CurveInk{LineColor::purple, {"coriolis", "#cc79a7", "#dd8fba"}},
                                          CurveInk{LineColor::orange, {"transverse", "#e69f00", "#e69f00"}},
                                          CurveInk{LineColor::sky, {"centrifugal", "#56b4e9", "#a5dcf7"}},
                                          CurveInk{LineColor::grey, {"fit", "#8a8f98", "#9aa0aa"}}};

inline constexpr Ink kPage{"bg", "#ffffff", "#111827"}, kHeading{"fg", "#111827", "#f9fafb"},
    kText{"text", "#374151", "#d1d5db"}, kMuted{"muted", "#5f6673", "#9ca3af"}, kGrid{"grid", "#e5e7eb", "#374151"},
    kMinor{"minor", "#f3f4f6", "#1f2937"};

/// Sizes of a picture's text (px): labels, the captions of panels, the title.
inline constexpr int kLabelSize = 12, kCaptionSize = 13, kTitleSize = 16;

}  // namespace earthtop
