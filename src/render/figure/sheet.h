// Several pictures in one, in rows, each with a caption under it.
#pragma once
#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"

namespace clench {

struct SheetOptions {
  std::vector<std::string> captions = {};  ///< UTF-8, of one or more lines, one
                                           ///< per picture; empty: none has one
  std::vector<std::string> notes = {};     ///< UTF-8, lines under all pictures, from the left
  int columns = 0;                         ///< 0: as many as make the sheet about as wide as high
  int gap = 12;                            ///< between pictures, and around all [pixels]
};

/// Cells are as large as the largest picture, with smaller ones in their middle, on white. Lines
/// of captions that are too long lose their middle, notes are broken into lines.
/// throws  Error without pictures, with another number of captions, with numbers out of range, and
///         when the sheet would be larger than 16384 pixels a side
Picture contact_sheet(const std::vector<const Picture*>& pictures, const SheetOptions& options,
                      const Font& font);

}  // namespace clench
