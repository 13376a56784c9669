#include "base/error.h"
#include "volume/import_times.h"
#include "vtkio/vtk_image.h"
#include "vtkio/vtk_messages.h"

#include <nlohmann/json.hpp>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <fstream>
#include <limits>
#include <string>

namespace isoglass {

namespace {

struct FileSeries {
    std::vector<std::filesystem::path> files;
    std::vector<double> times;
};

/// JSON: {"files": [{"name": "a.vti", "time": 0.5}, ...]}
FileSeries readJsonSeries(const std::filesystem::path& index) {
    std::ifstream stream(index, std::ios::binary);
    if (!stream) throw Error("cannot be opened", index.string());
    FileSeries series;
    try {
        const auto json = nlohmann::json::parse(stream);
        for (const auto& entry : json.at("files")) {
            series.files.push_back(index.parent_path() / entry.at("name").get<std::string>());
            series.times.push_back(entry.at("time").get<double>());
        }
    } catch (const nlohmann::json::exception& failure) {
        throw Error(std::string("not a series of files: ") + failure.what(), index.string(),
                    R"(it should read {"files": [{"name": "a.vti", "time": 0}]})");
    }
    return series;
}

/// XML: <VTKFile type="Collection"><Collection><DataSet timestep="0.5" part="0" file="a.vti"/>...
FileSeries readPvd(const std::filesystem::path& index) {
    const VtkMessages messages;
    const auto root =
        vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(index.c_str()));
    messages.throwIfAny(index.string());
    vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!collection)
        throw Error("not a PVD file", index.string(), "it must hold a <Collection> in a <VTKFile>");
    FileSeries series;
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* entry = collection->GetNestedElement(i);
        const std::string place = index.string() + ", DataSet " + std::to_string(i + 1);
        const char* file = entry->GetAttribute("file");
        double time = 0;
        int part = 0;
        if (!file || !*file) throw Error("the attribute \"file\" is missing", place);
        if (!entry->GetScalarAttribute("timestep", time))
            throw Error("the attribute \"timestep\" is no number", place);
        if (entry->GetScalarAttribute("part", part) && part != 0)
            throw Error("a time step in several parts cannot be read", place, "merge the parts first");
        series.files.push_back(index.parent_path() / file);
        series.times.push_back(time);
    }
    return series;
}

}  // namespace

std::unique_ptr<FrameSource> openVtkSeries(const std::filesystem::path& index, const ImportOptions& options) {
    const FileSeries series = index.extension() == ".pvd" ? readPvd(index) : readJsonSeries(index);
    if (series.files.empty()) throw Error("it lists no files", index.string());
    if (options.times.empty()) requireTimes(series.times, series.files.size(), index.string());
    return openVtkSequence(series.files, series.times, options);
}

}  // namespace isoglass
