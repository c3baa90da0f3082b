#pragma once
// Text out of files that were written anywhere, as names of displays and in reports: JSON and file names take
// no other text than UTF-8.

#include <set>
#include <string>
#include <string_view>

namespace curvewall {

// The text with every byte that belongs to no UTF-8 character read as Latin-1, as older programs wrote it.
std::string validUtf8(std::string_view text);

// A valid UTF-8 name with '_' for slashes, backslashes and control characters; names become parts of file
// names. "display" for an empty one.
std::string safeDisplayName(const std::string& name);

// The name, or with "-2", "-3" ... behind it the first one that is not taken. It is taken then.
std::string uniqueName(const std::string& name, std::set<std::string>& taken);

}  // namespace curvewall
