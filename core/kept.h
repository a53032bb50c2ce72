// The last of the values that were made, for who asks again.
#pragma once

#include <memory>
#include <optional>

namespace massprops {

template <class Key, class Value>
class Kept {
public:
  /// What was made from an equal key, or what `make` returns now.
  template <class Make>
  std::shared_ptr<const Value> get(const Key& key, const Make& make) {
    if (key_ != key) {
      key_.reset();
      value_.reset(); // there is memory for one
      value_ = std::make_shared<const Value>(make());
      key_ = key;
    }
    return value_;
  }

private:
  std::optional<Key> key_;
  std::shared_ptr<const Value> value_;
};

} // namespace massprops
