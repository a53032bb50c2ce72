// Ends a run in MeshLab's window, which has no means for that.
#pragma once

#include <QObject>

namespace massprops {

/// While it lives, all that a user does in the window waits for nothing and leads to nothing, but
/// for Escape and for closing the window.
class Escape : public QObject {
public:
  Escape();
  ~Escape() override;
  Escape(const Escape&) = delete;
  Escape& operator=(const Escape&) = delete;

  /// Takes notice of what has been done in the window; whether the run is to end.
  bool isWanted();

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  bool isWanted_ = false;
};

} // namespace massprops
