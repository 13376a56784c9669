#include "base/error.h"
#include "formats/file_source.h"
#include "formats/isolated_source.h"
#include "formats/orientation.h"
#include "vtkio/appended_data.h"
#include "vtkio/vtk_image.h"
#include "vtkio/vtk_messages.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace isoglass {

namespace {

constexpr const char* kGhosts = "vtkGhostType";

/// An array of a file, or one component of it.
struct ArrayChoice {
    std::string name;
    bool cells = false;
    int component = -1;  ///< -1: the array has one
};

/// "NAME:2" as the name and the component.
ArrayChoice parseVariable(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    const std::string digits = colon == std::string::npos ? "" : text.substr(colon + 1);
    if (digits.empty() || digits.size() > 4 ||
        !std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; }))
        return {text};
    return {text.substr(0, colon), false, std::stoi(digits)};
}

vtkSmartPointer<vtkXMLReader> makeReader(const std::filesystem::path& file) {
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(file, unreadable))
        throw Error("there is no such file", file.string());
    requireWholeXml(file);
    vtkSmartPointer<vtkXMLReader> reader;
    if (file.extension() == ".pvti")
        reader = vtkSmartPointer<vtkXMLPImageDataReader>::New();
    else
        reader = vtkSmartPointer<vtkXMLImageDataReader>::New();
    reader->SetFileName(file.c_str());
    return reader;
}

class VtkImageSource final : public FileSource {
  public:
    VtkImageSource(const std::filesystem::path& file, const std::string& variable)
        : file_(file), reader_(makeReader(file)) {
        reader_->UpdateInformation();
        messages_.throwIfAny(file.string());
        choose(variable);
        // Nothing but the frame and the fields of the file.
        reader_->GetPointDataArraySelection()->DisableAllArrays();
        reader_->GetCellDataArraySelection()->DisableAllArrays();
        describe(update());
    }

    const SeriesDescription& description() const override { return description_; }
    bool knowsTimes() const override { return knowsTimes_; }

    void read(std::size_t, std::span<float> samples) override {
        vtkDataArraySelection* selection =
            choice_.cells ? reader_->GetCellDataArraySelection() : reader_->GetPointDataArraySelection();
        selection->EnableArray(choice_.name.c_str());
        if (selection->ArrayExists(kGhosts)) selection->EnableArray(kGhosts);
        vtkImageData& image = update();
        vtkDataSetAttributes* attributes = image.GetPointData();
        if (choice_.cells) attributes = image.GetCellData();
        vtkDataArray* array = attributes->GetArray(choice_.name.c_str());
        if (!array) throw Error("array \"" + choice_.name + "\" holds no numbers", file_.string());
        if (array->GetNumberOfTuples() != static_cast<vtkIdType>(samples.size()))
            throw Error("array \"" + choice_.name + "\" has " + std::to_string(array->GetNumberOfTuples()) +
                            " values for " + std::to_string(samples.size()) + " samples",
                        file_.string(), "the file may be cut off or damaged");
        requireAppendedSize(file_, choice_.name,
                            static_cast<std::uint64_t>(array->GetNumberOfValues()) *
                                static_cast<std::uint64_t>(array->GetDataTypeSize()));
        if (choice_.component >= array->GetNumberOfComponents() ||
            (choice_.component < 0 && array->GetNumberOfComponents() != 1))
            throw Error("array \"" + choice_.name + "\" has " +
                            std::to_string(array->GetNumberOfComponents()) + " components",
                        file_.string(),
                        "choose one with --variable " + choice_.name + ":0 to " + choice_.name + ":" +
                            std::to_string(array->GetNumberOfComponents() - 1));
        copy(*array, attributes->GetArray(kGhosts), samples);
    }

  private:
    vtkImageData& update() {
        reader_->Update();
        messages_.throwIfAny(file_.string());
        auto* image = vtkImageData::SafeDownCast(reader_->GetOutputAsDataSet());
        if (!image) throw Error("the file holds no image data", file_.string());
        return *image;
    }

    /// Which array to read.
    void choose(const std::string& variable) {
        std::vector<ArrayChoice> all;
        std::string listed;
        const auto list = [&](vtkDataArraySelection* selection, bool cells) {
            for (int i = 0; i < selection->GetNumberOfArrays(); ++i) {
                const std::string name = selection->GetArrayName(i);
                if (name == kGhosts) continue;
                all.push_back({name, cells, -1});
                listed += (listed.empty() ? "" : ", ") + name + (cells ? " (cells)" : "");
            }
        };
        list(reader_->GetPointDataArraySelection(), false);
        list(reader_->GetCellDataArraySelection(), true);
        if (variable.empty()) {
            if (all.size() != 1)
                throw Error(all.empty() ? "the file has no array" : "the file has several arrays",
                            file_.string(), all.empty() ? "" : "choose one with --variable: " + listed);
            choice_ = all.front();
            return;
        }
        for (const ArrayChoice& wanted : {ArrayChoice{variable}, parseVariable(variable)}) {
            const auto found = std::ranges::find(all, wanted.name, &ArrayChoice::name);
            if (found == all.end()) continue;
            choice_ = {found->name, found->cells, wanted.component};
            return;
        }
        throw Error("there is no array \"" + variable + "\"", file_.string(),
                    "arrays in the file: " + (listed.empty() ? "none" : listed));
    }

    void describe(vtkImageData& image) {
        int extent[6];
        image.GetExtent(extent);
        std::array<std::uint64_t, 3> lengths{};
        AffinePlace place;
        place.origin = {image.GetOrigin()[0], image.GetOrigin()[1], image.GetOrigin()[2]};
        for (int k = 0; k < 3; ++k) {
            const std::int64_t points = std::int64_t{extent[2 * k + 1]} - extent[2 * k] + 1;
            lengths[static_cast<std::size_t>(k)] =
                static_cast<std::uint64_t>(std::max<std::int64_t>(points - (choice_.cells ? 1 : 0), 0));
            for (int row = 0; row < 3; ++row)
                place.steps[static_cast<std::size_t>(k)][row] =
                    image.GetDirectionMatrix()->GetElement(row, k) * image.GetSpacing()[k];
            place.origin +=
                place.steps[static_cast<std::size_t>(k)] * (extent[2 * k] + (choice_.cells ? 0.5 : 0));
        }
        requireVolume(lengths, file_.string());
        OrientedAxes oriented = orient(place, lengths, file_.string());
        description_.lattice = std::move(oriented.lattice);
        description_.notes = std::move(oriented.notes);
        arrange(lengths, oriented.axes);
        describeTime(*image.GetFieldData());
        description_.name = choice_.name;
        if (choice_.component >= 0) description_.name += ":" + std::to_string(choice_.component);
        description_.provenance = file_.filename().string() + ", VTK image data, array " + description_.name;
    }

    void describeTime(vtkFieldData& fields) {
        description_.time.times = {0};
        for (const char* name : {"TimeValue", "TimeStep"}) {
            vtkDataArray* array = fields.GetArray(name);
            if (!array || array->GetNumberOfValues() != 1) continue;
            description_.time.times = {array->GetComponent(0, 0)};
            knowsTimes_ = true;
            return;
        }
    }

    void arrange(const std::array<std::uint64_t, 3>& lengths, const std::array<std::size_t, 3>& axes) {
        lengths_ = lengths;
        std::uint64_t stride = 1;
        for (const std::size_t axis : axes) {
            strides_[axis] = stride;
            stride *= lengths[axis];
        }
    }

    void copy(vtkDataArray& array, vtkDataArray* ghosts, std::span<float> samples) const {
        const int component = std::max(choice_.component, 0);
        const int hidden =
            choice_.cells ? int{vtkDataSetAttributes::HIDDENCELL} : int{vtkDataSetAttributes::HIDDENPOINT};
        vtkIdType tuple = 0;
        for (std::uint64_t k = 0; k < lengths_[2]; ++k)
            for (std::uint64_t j = 0; j < lengths_[1]; ++j)
                for (std::uint64_t i = 0; i < lengths_[0]; ++i, ++tuple) {
                    const auto sample = static_cast<float>(array.GetComponent(tuple, component));
                    const bool missing =
                        !(std::abs(sample) <= kLargestValue) ||
                        (ghosts && (static_cast<int>(ghosts->GetComponent(tuple, 0)) & hidden) != 0);
                    samples[k * strides_[2] + j * strides_[1] + i * strides_[0]] =
                        missing ? std::numeric_limits<float>::quiet_NaN() : sample;
                }
    }

    std::filesystem::path file_;
    VtkMessages messages_;
    vtkSmartPointer<vtkXMLReader> reader_;
    ArrayChoice choice_;
    std::array<std::uint64_t, 3> lengths_{};
    std::array<std::uint64_t, 3> strides_{};
    SeriesDescription description_;
    bool knowsTimes_ = false;
};

}  // namespace

std::unique_ptr<FrameSource> openVtkImages(std::span<const std::filesystem::path> files,
                                           const ImportOptions& options) {
    return openVtkSequence(files, {}, options);
}

std::unique_ptr<FrameSource> openVtkSequence(std::span<const std::filesystem::path> files,
                                             const std::vector<double>& times, const ImportOptions& options) {
    const OpenFile open = [](const std::filesystem::path& file, const std::string& variable) {
        return std::make_unique<VtkImageSource>(file, variable);
    };
    return openIsolated(files, [&] { return openSequence(files, open, options, "VTK image data", times); });
}

}  // namespace isoglass
