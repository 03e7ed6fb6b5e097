// Input events of a user interface: mouse, keyboard, text.
#pragma once
#include <optional>
#include <string>

namespace clench {

/// One input event. Positions are in pixels from the upper left corner of the screen.
struct InputEvent {
  enum class Kind { move, button, wheel, key, text, resize, close, drop };
  Kind kind = Kind::move;
  double x = 0, y = 0;  ///< move: position; wheel: steps right and up; resize: new size [pixels]
  int code = 0;         ///< button: 0 left, 1 right, 2 middle; key: GLFW key code
  bool down = false;    ///< state of a button or key
  std::optional<double> time = {};  ///< button: of the event [s]; by default that of its frame
  std::string text = {};            ///< text: one character in UTF-8; drop: path of a file
};

}  // namespace clench
