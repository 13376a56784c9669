#pragma once

#include "formats/file_source.h"

namespace isoglass {

// Formats of a header that describes an array of plain numbers, in the file or in others beside it.
// Each opens one file and throws Error; axes are brought to world axes by `orient`, and anatomical
// coordinates to right-anterior-superior, so that volumes of one patient agree.

/// NIfTI-1, .nii, .nii.gz, or .hdr with .img: all time steps; orientation by sform, else qform, else
/// by the spacing alone; `scl_slope` and `scl_inter`.
std::unique_ptr<FileSource> openNifti(const std::filesystem::path& file, const std::string& variable);

/// NRRD 1 to 5, .nrrd or .nhdr with its data files; raw or gzip. The axis of the key frames may be any.
std::unique_ptr<FileSource> openNrrd(const std::filesystem::path& file, const std::string& variable);

/// MetaImage, .mha or .mhd with its data files; raw or compressed; a fourth dimension is time.
std::unique_ptr<FileSource> openMetaImage(const std::filesystem::path& file, const std::string& variable);

/// SLC of VolVis: 8 bits, plain or run lengths.
std::unique_ptr<FileSource> openSlc(const std::filesystem::path& file, const std::string& variable);

}  // namespace isoglass
