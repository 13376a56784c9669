#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace isoglass {

/// Orders names as people do: runs of digits by their value ("t2" before "t10"), the rest by letters.
bool naturalLess(const std::filesystem::path& a, const std::filesystem::path& b);

/// The number in the name of each file that tells them apart; in the name of a single file, its last
/// number. A number is digits, with decimals where a point and digits follow; the ending (".vti", ".nii.gz")
/// is not looked at. Throws Error where a name has no number, or several numbers differ between the names.
std::vector<double> numbersInNames(std::span<const std::filesystem::path> files);

}  // namespace isoglass
