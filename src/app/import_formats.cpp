#include "app/import_formats.h"

#include "base/error.h"
#include "formats/file_source.h"
#include "formats/foreign_vdb.h"
#include "formats/header_text.h"
#include "formats/isolated_source.h"
#include "formats/medical_images.h"
#include "formats/payload.h"
#include "formats/raw_json.h"
#if ISOGLASS_VTK
#include "vtkio/vtk_image.h"
#endif

#include <algorithm>
#include <array>

namespace isoglass {

namespace {

using std::filesystem::path;

constexpr std::size_t kStartBytes = 1024;

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

const path& onlyFile(std::span<const path> files, std::string_view format) {
    if (files.size() > 1)
        throw Error("a series of " + std::string(format) + " is one file, but " +
                        std::to_string(files.size()) + " were given",
                    files[1].string(), "name one file");
    return files.front();
}

/// The start of a file, as it is where it cannot be decompressed: the format's reader says what is wrong.
std::string startOf(const path& file) {
    try {
        return readStart(file, kStartBytes);
    } catch (const Error&) {
        return {};
    }
}

template <const char* format, std::unique_ptr<FileSource> (*open)(const path&, const std::string&)>
std::unique_ptr<FrameSource> openFiles(std::span<const path> files, const ImportOptions& options) {
    return openSequence(files, open, options, format);
}

constexpr char kNifti[] = "NIfTI";
constexpr char kNrrd[] = "NRRD";
constexpr char kMetaImage[] = "MetaImage";
constexpr char kSlc[] = "SLC";
constexpr char kRaw[] = "RAW";

#if ISOGLASS_VTK
constexpr bool kVtk = true;
constexpr auto kOpenVtkImages = &openVtkImages;
constexpr auto kOpenVtkSeries = [](std::span<const path> files, const ImportOptions& options) {
    return openVtkSeries(onlyFile(files, "PVD"), options);
};
#else
constexpr bool kVtk = false;
constexpr decltype(ImportFormat::open) kOpenVtkImages = nullptr;
constexpr decltype(ImportFormat::open) kOpenVtkSeries = nullptr;
#endif

/// The NetCDF and HDF5 libraries crash or loop on some damaged files.
std::unique_ptr<FrameSource> openNetcdfFile(std::span<const path> files, const ImportOptions& options) {
    const path& file = onlyFile(files, "NetCDF");
    return openIsolated(files, [file, options] { return openNetcdf(file, options); });
}

const std::array<ImportFormat, 10> kFormats = {{
    {"NetCDF", ".nc .nc4 .cdf", true, true,
     [](std::string_view start) { return start.starts_with("CDF") || start.starts_with("\x89HDF"); },
     &openNetcdfFile},
    {"PVM", ".pvm", true, false,
     [](std::string_view start) { return start.starts_with("PVM") || start.starts_with("DDS v3"); },
     &openPvm},
    {"VTK image data", ".vti .pvti", kVtk, false,
     [](std::string_view start) { return contains(start, "<VTKFile") && contains(start, "ImageData\""); },
     kOpenVtkImages},
    {"VTK series", ".pvd .vti.series", kVtk, false,
     [](std::string_view start) {
         return (contains(start, "<VTKFile") && contains(start, "\"Collection\"")) ||
                contains(start, "\"file-series-version\"");
     },
     kOpenVtkSeries},
    {"NIfTI", ".nii .nii.gz .hdr .hdr.gz", true, false,
     [](std::string_view start) {
         constexpr std::size_t kMagic = 344;
         return start.size() >= kMagic + 4 &&
                (start.substr(kMagic, 3) == "n+1" || start.substr(kMagic, 3) == "ni1");
     },
     &openFiles<kNifti, &openNifti>},
    {"NRRD", ".nrrd .nhdr", true, false, [](std::string_view start) { return start.starts_with("NRRD000"); },
     &openFiles<kNrrd, &openNrrd>},
    {"MetaImage", ".mha .mhd", true, false,
     [](std::string_view start) { return start.starts_with("ObjectType") || start.starts_with("NDims"); },
     &openFiles<kMetaImage, &openMetaImage>},
    {"SLC", ".slc", true, false, [](std::string_view start) { return start.starts_with("11111\n"); },
     &openFiles<kSlc, &openSlc>},
    {"OpenVDB", ".vdb", true, false, [](std::string_view start) { return start.starts_with(" BDV"); },
     &openForeignVdb},
    {"RAW with a JSON description", ".json", true, false,
     [](std::string_view start) { return contains(start, "\"isoglass-raw\""); }, &openFiles<kRaw, &openRaw>},
}};

bool hasEnding(const path& file, const ImportFormat& format) {
    const std::string name = lowerCase(file.filename().string());
    return std::ranges::any_of(words(format.endings),
                               [&](std::string_view ending) { return name.ends_with(ending); });
}

}  // namespace

std::string listImportFormats() {
    std::string text = "Formats:\n";
    for (const ImportFormat& format : kFormats) {
        text += "  " + std::string(format.name) + " (" + std::string(format.endings) + ")";
        text += format.available ? "\n" : ", not in this build: it was made without VTK\n";
    }
    return text;
}

const ImportFormat& findImportFormat(const path& file) {
    const std::string start = startOf(file);
    auto found =
        std::ranges::find_if(kFormats, [&](const ImportFormat& format) { return format.begins(start); });
    if (found == kFormats.end())
        found = std::ranges::find_if(kFormats,
                                     [&](const ImportFormat& format) { return hasEnding(file, format); });
    if (found == kFormats.end())
        throw Error(
            "the format of the file is not known", file.string(),
            "'isoglass import --help' lists what can be read; plain numbers need a JSON description beside "
            "them");
    if (!found->available)
        throw Error("this build cannot read " + std::string(found->name), file.string(),
                    "install libvtk9-dev and build again");
    return *found;
}

}  // namespace isoglass
