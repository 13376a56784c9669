#pragma once

#include <glm/vec3.hpp>

namespace isoglass {

/// Line drawings that show what a surface hides: J. Fischer, D. Bartz and W. Strasser, "Illustrative Display
/// of Hidden Iso-Surface Structures", 2005; equations and defaults are those of the paper.
///
/// The first and the second surface that a pixel meets are drawn as silhouettes, the first one also hatched
/// where it is dark. Secondary geometry stays visible behind both, in its own colour.
struct IllustrativeStyle {
    float alpha = 0.7f;  ///< brightness of secondary geometry behind one surface (2), from beta to 1
    float beta = 0.21f;  ///< behind two, from 0 to alpha
    /// The depth that changes by so many pixel sizes from a pixel to the next makes a silhouette (3). The
    /// paper compares differences of the depth buffer, whose meaning depends on the near plane: see
    /// depthThresholdFromPaper.
    float depthThreshold = 5;
    /// The sum of the cosines between a pixel's normal and its four neighbours' below which it is one (5), -4
    /// to 4.
    float normalThreshold = 3.98f;
    float hatchAngle = 20;  ///< of the strokes against the rows of the picture, degrees (7)
    float hatchSize = 4;    ///< from stroke to stroke, pixels (7)
    /// Where more light than this falls, strokes of one direction are left (8, 9), 0 to 1. The paper's text
    /// says the opposite, its equations this.
    float hatchCross = 0.9f;
    /// Towards the light, in view coordinates: x to the right, y upwards, z towards the eye; any length but 0
    /// (1, 6).
    glm::vec3 light{-0.3f, 0.35f, 0.9f};
    glm::vec3 paper{0.91309865f, 0.90466117f, 0.87136711f};  ///< linear, like the colours below; #f5f4f0
    glm::vec3 front{0};  ///< silhouettes and hatching of the first surface
    glm::vec3 back{0.55201144f, 0.0144438436f, 0.0144438436f};  ///< silhouettes of the second; #c42020

    friend bool operator==(const IllustrativeStyle&, const IllustrativeStyle&) = default;
};

/// What the paper's threshold for a Sobel filter (sums of weights 1, 2, 1, not divided) over a depth buffer
/// n/z means here, for a surface at the distance `nearsAway` near planes, in pictures of `rows` rows whose
/// height is seen under `fovDegrees`: with z the distance, a depth that changes by t pixel sizes a pixel
/// changes n/z by t n/z 2 tan(fov/2)/rows, and the filter gives 8 times that.
double depthThresholdFromPaper(double threshold, double nearsAway, int rows, double fovDegrees);

}  // namespace isoglass
