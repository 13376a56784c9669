#include "formats/foreign_vdb.h"
#include "formats/medical_images.h"
#include "formats/raw_json.h"
#include "unit/formats/small_files.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <unistd.h>

namespace isoglass {

namespace {

using test::SmallArray;
using test::write;

/// A small file of one format and how it is opened.
struct Specimen {
    std::string name;
    std::string bytes;
    std::function<std::unique_ptr<FrameSource>(const std::filesystem::path&)> open;
    bool hasChecksum;      ///< of its samples
    std::size_t step = 1;  ///< from damage to damage, in bytes; a reader in its own process takes longer
};

std::string vdbBytes() {
    openvdb::initialize();
    auto grid = openvdb::FloatGrid::create(0.5f);
    grid->setName("density");
    for (int i = 0; i < 12; ++i) grid->tree().setValue({i, 2 * i, 3}, static_cast<float>(i));
    const auto path = std::filesystem::path(testing::TempDir()) /
                      ("isoglass_specimen_" + std::to_string(::getpid()) + ".vdb");
    openvdb::io::File(path.string()).write({grid});
    const std::string bytes = test::contentOf(path);
    std::filesystem::remove(path);
    return bytes;
}

std::unique_ptr<FrameSource> openOneVdb(const std::filesystem::path& file) {
    const std::vector<std::filesystem::path> files = {file};
    return openForeignVdb(files, {});
}

/// By name: a specimen is made where it is used.
Specimen specimen(const std::string& name) {
    const SmallArray array, single{.frames = 1};
    const auto nifti = [](const std::filesystem::path& file) { return openNifti(file, ""); };
    const auto nrrd = [](const std::filesystem::path& file) { return openNrrd(file, ""); };
    const auto meta = [](const std::filesystem::path& file) { return openMetaImage(file, ""); };
    const auto slc = [](const std::filesystem::path& file) { return openSlc(file, ""); };
    const auto raw = [](const std::filesystem::path& file) { return openRaw(file, ""); };
    if (name == "a.nii") return {name, test::niftiBytes(array), nifti, false};
    if (name == "a.nii.gz") return {name, test::deflated(test::niftiBytes(array)), nifti, true};
    if (name == "a.nrrd") return {name, test::nrrdBytes(array, test::nrrdDirections(array)), nrrd, false};
    if (name == "b.nrrd") return {name, test::nrrdBytes(array, "spacings: 1 1 1 1\n", true), nrrd, false};
    if (name == "a.mha") return {name, test::metaImageBytes(array), meta, false};
    if (name == "a.slc") return {name, test::slcBytes(single, true), slc, false};
    if (name == "a.json")
        return {
            name,
            R"({"format": "isoglass-raw", "version": 1, "type": "u8", "dims": [2, 2, 2], "files": "a.json",)"
            R"( "skip": 0, "spacing": [1, 2, 3], "time": {"times": [1.5], "units": "s"}, "missing": 7})",
            raw, false};
    const std::string vdb = vdbBytes();
    // Some of the damage makes OpenVDB take hundreds of megabytes: 50 places, odd so that every bit has its
    // turn.
    return {name, vdb, openOneVdb, false, (vdb.size() / 50) | 1};
}

class Damage : public testing::TestWithParam<const char*> {
  protected:
    ScratchFolder folder_;
    Specimen specimen_ = specimen(GetParam());

    /// Everything that the bytes hold; nothing where they are refused. Any exception but Error ends the test.
    std::optional<std::vector<float>> tryToRead(const std::string& bytes) const {
        const auto path = folder_ / specimen_.name;
        write(path, bytes);
        try {
            const auto source = specimen_.open(path);
            std::vector<float> all;
            for (std::size_t i = 0; i < source->description().time.times.size(); ++i) {
                const auto samples = test::readFrame(*source, i);
                all.insert(all.end(), samples.begin(), samples.end());
            }
            return all;
        } catch (const Error& error) {
            // The place is this file, or one that the damaged file names.
            EXPECT_NE(std::string(error.what()).find(folder_.path().string()), std::string::npos)
                << error.what();
            return std::nullopt;
        }
    }
};

TEST_P(Damage, FlippedBitsNeverCrash) {
    const auto whole = tryToRead(specimen_.bytes);
    // The description that names itself has the wrong size for its samples.
    if (specimen_.name != "a.json") {
        ASSERT_TRUE(whole);
    }
    std::size_t refused = 0;
    for (std::size_t position = 0; position < specimen_.bytes.size(); position += specimen_.step) {
        std::string bytes = specimen_.bytes;
        bytes[position] = static_cast<char>(bytes[position] ^ (1 << position % 8));
        const auto read = tryToRead(bytes);
        refused += !read;
        // What gzip says of the file's name and time may change.
        if (specimen_.hasChecksum && read) {
            EXPECT_EQ(*read, *whole) << position;
        }
    }
    EXPECT_GT(refused, 0u);
}

TEST_P(Damage, TruncatedFilesAreRefused) {
    for (std::size_t size = 0; size < specimen_.bytes.size(); size += 5 * specimen_.step)
        EXPECT_FALSE(tryToRead(specimen_.bytes.substr(0, size))) << size;
}

INSTANTIATE_TEST_SUITE_P(Formats, Damage,
                         testing::Values("a.nii", "a.nii.gz", "a.nrrd", "b.nrrd", "a.mha", "a.slc", "a.json",
                                         "a.vdb"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::erase(name, '.');
                             return name;
                         });

}  // namespace

}  // namespace isoglass
