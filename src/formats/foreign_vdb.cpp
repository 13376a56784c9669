#include "formats/foreign_vdb.h"

#include "base/error.h"
#include "formats/file_source.h"
#include "formats/isolated_source.h"
#include "formats/orientation.h"
#include "formats/vdb_extent.h"
#include "volume/import_times.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace isoglass {

namespace {

using openvdb::CoordBBox;
using openvdb::DoubleGrid;
using openvdb::FloatGrid;

/// File metadata that IsoGlass writes.
constexpr const char* kOwnKey = "isoglass.series";

bool isScalar(const openvdb::GridBase& grid) {
    return grid.isType<FloatGrid>() || grid.isType<DoubleGrid>();
}

std::unique_ptr<openvdb::io::File> openFile(const std::filesystem::path& path, bool delayed) {
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(path, unreadable))
        throw Error("there is no such file", path.string());
    requireWholeVdb(path);
    auto file = std::make_unique<openvdb::io::File>(path.string());
    file->setCopyMaxBytes(0);
    try {
        file->open(delayed);
    } catch (const openvdb::Exception& failure) {
        throw Error(std::string("not a readable OpenVDB file: ") + failure.what(), path.string());
    }
    if (file->getMetadata() && (*file->getMetadata())[kOwnKey])
        throw Error("this is a series of IsoGlass already", path.string(), "it needs no import");
    return file;
}

/// The name of the grid to read: the one wanted, or the only one of numbers.
std::string chooseGrid(openvdb::io::File& file, const std::string& wanted,
                       const std::filesystem::path& path) {
    std::vector<std::string> scalars;
    std::string listed;
    const auto grids = file.readAllGridMetadata();
    for (const auto& grid : *grids) {
        if (grid->getName() == wanted && !wanted.empty()) {
            if (!isScalar(*grid))
                throw Error("grid \"" + wanted + "\" holds " + grid->valueType() + ", not one number a voxel",
                            path.string());
            return wanted;
        }
        if (!isScalar(*grid)) continue;
        scalars.push_back(grid->getName());
        listed += (listed.empty() ? "" : ", ") + grid->getName();
    }
    if (!wanted.empty())
        throw Error("there is no grid \"" + wanted + "\"", path.string(),
                    "grids of numbers in the file: " + (listed.empty() ? "none" : listed));
    if (scalars.empty()) throw Error("the file has no grid of float or double", path.string());
    if (scalars.size() > 1)
        throw Error("the file has several grids", path.string(), "choose one with --variable: " + listed);
    return scalars.front();
}

openvdb::GridBase::Ptr readGrid(const std::filesystem::path& path, const std::string& variable,
                                bool delayed) {
    const auto file = openFile(path, delayed);
    try {
        const std::string name = chooseGrid(*file, variable, path);
        return file->readGrid(name);
    } catch (const openvdb::Exception& failure) {
        throw Error(std::string("the grid cannot be read: ") + failure.what(), path.string(),
                    "the file may be cut off or damaged");
    }
}

AffinePlace placeOf(const openvdb::GridBase& grid, const openvdb::Coord& first,
                    const std::filesystem::path& path) {
    if (!grid.transform().isLinear())
        throw Error("the grid is placed by a perspective or another curved transform", path.string(),
                    "resample it to a linear one first");
    const auto world = [&](const openvdb::Coord& index) {
        const openvdb::Vec3d point = grid.indexToWorld(index.asVec3d());
        return glm::dvec3(point.x(), point.y(), point.z());
    };
    AffinePlace place;
    place.origin = world(first);
    const glm::dvec3 zero = world({0, 0, 0});
    place.steps = {world({1, 0, 0}) - zero, world({0, 1, 0}) - zero, world({0, 0, 1}) - zero};
    return place;
}

/// Samples of the box, x of the index fastest.
void copySamples(const openvdb::GridBase& grid, const CoordBBox& box, std::span<float> samples) {
    openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, samples.data());
    // Serial: the process has no other threads.
    if (grid.isType<FloatGrid>())
        openvdb::tools::copyToDense(static_cast<const FloatGrid&>(grid), dense, true);
    else
        openvdb::tools::copyToDense(static_cast<const DoubleGrid&>(grid), dense, true);
    for (float& sample : samples)
        if (!(std::abs(sample) <= kLargestValue)) sample = std::numeric_limits<float>::quiet_NaN();
}

class ForeignVdbSource final : public FrameSource {
  public:
    ForeignVdbSource(std::span<const std::filesystem::path> files, const ImportOptions& options)
        : files_(files.begin(), files.end()), variable_(options.variable) {
        openvdb::initialize();
        if (files_.empty()) throw Error("no files", "OpenVDB");
        openvdb::GridBase::Ptr first;
        for (const auto& file : files_) {
            const auto grid = readGrid(file, variable_, /*delayed=*/true);
            if (!first) first = grid;
            if (variable_.empty()) variable_ = grid->getName();
            if (!(grid->transform() == first->transform()))
                throw Error("the transform differs from that of the first file", file.string(),
                            "all files of a sequence must agree");
            const CoordBBox box = grid->evalActiveVoxelBoundingBox();
            if (!box.empty()) box_.expand(box);
        }
        if (box_.empty()) throw Error("no voxel is active", files_.front().string());
        requireSize();
        box_.expand(1);
        describe(*first, options.times);
    }

    const SeriesDescription& description() const override { return description_; }

    void read(std::size_t frame, std::span<float> samples) override {
        const auto grid = readGrid(files_.at(frame), variable_, /*delayed=*/false);
        if (axes_ == std::array<std::size_t, 3>{0, 1, 2}) {
            copySamples(*grid, box_, samples);
            return;
        }
        ordered_.resize(samples.size());
        copySamples(*grid, box_, ordered_);
        reorder(samples);
    }

  private:
    void requireSize() const {
        std::array<std::uint64_t, 3> lengths{};
        for (int k = 0; k < 3; ++k) {
            // In 64 bits: the corners of a damaged box may be as far apart as integers are.
            lengths[static_cast<std::size_t>(k)] =
                static_cast<std::uint64_t>(std::int64_t{box_.max()[k]} - box_.min()[k] + 3);
        }
        const std::uint64_t bytes = requireVolume(lengths, files_.front().string()) * sizeof(float);
        const auto memory = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                            static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
        if (bytes > memory / 2)
            throw Error("the active voxels span " + std::to_string(lengths[0]) + " x " +
                            std::to_string(lengths[1]) + " x " + std::to_string(lengths[2]) +
                            " samples, too many for the memory",
                        files_.front().string(), "an import holds one key frame densely");
    }

    void describe(const openvdb::GridBase& grid, const std::vector<double>& times) {
        std::array<std::uint64_t, 3> lengths{};
        for (int k = 0; k < 3; ++k)
            lengths[static_cast<std::size_t>(k)] = static_cast<std::uint64_t>(box_.dim()[k]);
        OrientedAxes oriented =
            orient(placeOf(grid, box_.min(), files_.front()), lengths, files_.front().string());
        axes_ = oriented.axes;
        description_.name = variable_;
        description_.lattice = std::move(oriented.lattice);
        description_.notes = std::move(oriented.notes);
        description_.notes.push_back(
            "The samples fill the box of the active voxels and one voxel around it; voxels that are not "
            "active "
            "keep the value of the tree (background " +
            std::to_string(background(grid)) + ")");
        description_.time.times = times;
        if (times.empty())
            for (std::size_t i = 0; i < files_.size(); ++i)
                description_.time.times.push_back(static_cast<double>(i));
        requireTimes(description_.time.times, files_.size(), "--times");
        description_.provenance = files_.front().filename().string() + ", OpenVDB, grid " + variable_;
        if (files_.size() > 1)
            description_.provenance = files_.front().filename().string() + " to " +
                                      files_.back().filename().string() + ", OpenVDB, grid " + variable_ +
                                      ", " + std::to_string(files_.size()) + " files";
    }

    static double background(const openvdb::GridBase& grid) {
        return grid.isType<FloatGrid>() ? static_cast<const FloatGrid&>(grid).background()
                                        : static_cast<const DoubleGrid&>(grid).background();
    }

    /// From the index axes of the grid to x, y, z.
    void reorder(std::span<float> samples) const {
        std::array<std::size_t, 3> strides{};
        std::size_t stride = 1;
        for (std::size_t world = 0; world < 3; ++world) {
            strides[axes_[world]] = stride;
            stride *= static_cast<std::size_t>(box_.dim()[static_cast<int>(axes_[world])]);
        }
        const float* sample = ordered_.data();
        for (int k = 0; k < box_.dim()[2]; ++k)
            for (int j = 0; j < box_.dim()[1]; ++j)
                for (int i = 0; i < box_.dim()[0]; ++i)
                    samples[static_cast<std::size_t>(k) * strides[2] +
                            static_cast<std::size_t>(j) * strides[1] +
                            static_cast<std::size_t>(i) * strides[0]] = *sample++;
    }

    std::vector<std::filesystem::path> files_;
    std::string variable_;
    CoordBBox box_;
    std::array<std::size_t, 3> axes_{0, 1, 2};
    SeriesDescription description_;
    std::vector<float> ordered_;
};

}  // namespace

std::unique_ptr<FrameSource> openForeignVdb(std::span<const std::filesystem::path> files,
                                            const ImportOptions& options) {
    return openIsolated(files, [&] { return std::make_unique<ForeignVdbSource>(files, options); });
}

}  // namespace isoglass
