#include "fuzz/source_check.h"
#include "vtkio/appended_data.h"
#include "vtkio/vtk_image.h"

#include <array>
#include <filesystem>
#include <fstream>

namespace isoglass::fuzz {

namespace {

/// A folder of this process for files whose ending matters.
class Folder {
  public:
    Folder() : path_(std::filesystem::temp_directory_path() / ("vtk_fuzz-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path write(const char* name, std::string_view text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

/// The reader of raw appended data is asked for an array as the image reader asks.
void checkAppended(const std::filesystem::path& file) {
    try {
        requireAppendedSize(file, "values", 8);
    } catch (const Error&) {
    }
}

}  // namespace

// The first byte says what the rest is: an index of either kind, or an image. Images go through their process
// of their own one time in 16, because starting it takes a thousand times as long as all the rest.
void run(std::span<const std::uint8_t> data) {
    static const Folder folder;
    if (data.empty()) return;
    const std::string_view text = asText(data.subspan(1));
    switch (data[0] % 16) {
        case 'p' % 16: {
            const auto index = folder.write("index.pvd", text);
            return checkSource([&] { return openVtkSeries(index, {}); });
        }
        case 's' % 16: {
            const auto index = folder.write("index.vti.series", text);
            return checkSource([&] { return openVtkSeries(index, {}); });
        }
        case 'i' % 16: {
            const std::array files{folder.write("image.vti", text)};
            return checkSource([&] { return openVtkImages(files, {}); });
        }
        default:
            return checkAppended(folder.write("image.vti", text));
    }
}

}  // namespace isoglass::fuzz
