#include "filter_massprops/escape.h"

#include <QApplication>
#include <QEvent>
#include <QKeyEvent>

namespace massprops {

Escape::Escape() {
  qApp->installEventFilter(this);
}

Escape::~Escape() {
  qApp->removeEventFilter(this);
}

bool Escape::isWanted() {
  QApplication::processEvents();
  return isWanted_;
}

bool Escape::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
  case QEvent::ShortcutOverride:
  case QEvent::KeyPress:
    if (static_cast<const QKeyEvent*>(event)->key() == Qt::Key_Escape) isWanted_ = true;
    return true;
  case QEvent::Close:
    isWanted_ = true;
    event->ignore(); // the window stays until the run has ended
    return true;
  case QEvent::KeyRelease:
  case QEvent::Shortcut:
  case QEvent::MouseButtonPress:
  case QEvent::MouseButtonRelease:
  case QEvent::MouseButtonDblClick:
  case QEvent::Wheel:
  case QEvent::ContextMenu:
  case QEvent::Drop:
    return true;
  default:
    return QObject::eventFilter(watched, event);
  }
}

} // namespace massprops
