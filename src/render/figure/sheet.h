// Contact sheet: several pictures in rows, each with a caption under it.
#pragma once
#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"

namespace clench {

struct SheetOptions {
  /// UTF-8, one per picture, of one or more lines; empty: no captions
  std::vector<std::string> captions = {};
  std::vector<std::string> notes = {};  ///< UTF-8, lines under all pictures, left-aligned
  int columns = 0;                      ///< 0: chosen so that the sheet is about square
  int gap = 12;                         ///< between pictures, and around the sheet [pixels]
};

/// Cells have the size of the largest picture; smaller ones are centered, on white. Caption lines
/// that are too long are shortened in the middle, notes are broken into lines.
/// throws  Error without pictures, if the number of captions differs from theirs, if a number is
///         out of range, and if the sheet would exceed 16384 pixels per side
Picture contact_sheet(const std::vector<const Picture*>& pictures, const SheetOptions& options,
                      const Font& font);

}  // namespace clench
