// The filter's dialog on small screens.
#pragma once

namespace massprops {

/// Keeps the dialog that MeshLab is about to open, of this title, within the screen, and its
/// buttons in view: the parameters scroll. MeshLab 2020.09 has no scroll bar, and later versions
/// open as high as all the parameters.
void fitDialogToScreen(const char* title);

} // namespace massprops
