// ui: panels and widgets over a picture, as scripts describe them frame by frame.
#pragma once
#include <memory>

#include "clench/script/lua/object.h"

namespace clench {

class Gui;

struct UiHandle {
  std::shared_ptr<Gui> gui;  ///< null after it is closed
  bool in_frame = false;
};

extern const Class ui_class, ui_widgets_class, ui_plots_class, ui_containers_class;
extern const Library ui_library;

template <>
inline constexpr const Class* script_class<UiHandle> = &ui_class;

}  // namespace clench
