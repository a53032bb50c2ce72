// Files that are there whole or not at all.
#pragma once

#include <functional>
#include <string>

namespace massprops {

/// Nothing that is there is changed.
/// \throw InvalidInput when no 3MF file can be written at that path, UTF-8
void requireWritable(const std::string& path);

/// Lets `write` make a file beside `path`, which then takes its place. What was there stays where
/// anything fails. \throw what `write` throws, std::runtime_error
void writeWhole(const std::string& path,
                const std::function<void(const std::string& temporary)>& write);

} // namespace massprops
