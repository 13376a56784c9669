#pragma once

#include <filesystem>
#include <string>

namespace isoglass {

/// Collects what VTK reports while it lives; nothing is printed, and VTK's log stays
/// off afterwards. One at a time.
class VtkMessages {
  public:
    VtkMessages();
    ~VtkMessages();
    VtkMessages(const VtkMessages&) = delete;
    VtkMessages& operator=(const VtkMessages&) = delete;

    /// Throws Error with the first message, if there was one, and `file` as its place.
    void throwIfAny(const std::string& file) const;
};

/// Throws Error where the XML file does not end with </VTKFile>: VTK's readers take what is missing at the
/// end for zeros or for what the memory held before.
void requireWholeXml(const std::filesystem::path& file);

}  // namespace isoglass
