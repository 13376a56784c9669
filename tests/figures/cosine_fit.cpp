// Figure 4 of S. Roettger, "Volume rendering with libMini" (2007): transmittance of a thin spherical shell
// against the sine of the angle of view, and the powers of the cosine that are fitted to it.
//
//     cosine_fit OUT.png
//
// Grey: the two spheres. Red: the shell. Blue: the paper's power. Green: the power fitted too.

#include "optics/shell_transmittance.h"
#include "render/legend.h"
#include "render/png_file.h"

#include <glm/common.hpp>

#include <cmath>
#include <functional>
#include <iostream>

namespace {

using namespace isoglass;

constexpr double kExtinction = 10;
constexpr double kThickness = 0.05;
constexpr int kLeft = 48, kTop = 16, kSide = 512;

class Plot {
  public:
    Plot() {
        image_.size = {kLeft + kSide + 16, kTop + kSide + 32};
        image_.pixels.assign(static_cast<std::size_t>(image_.size.x) * image_.size.y, {255, 255, 255, 255});
        for (int i = 0; i <= 10; i += 2) {
            const int x = kLeft + i * kSide / 10;
            const int y = kTop + kSide - i * kSide / 10;
            for (int j = 0; j <= kSide; ++j) {
                image_.at(x, kTop + j) = {225, 225, 225, 255};
                image_.at(kLeft + j, y) = {225, 225, 225, 255};
            }
            const std::string text = i == 10 ? "1" : "0." + std::to_string(i);
            drawText(image_, {x - 8, kTop + kSide + 10}, text, {0, 0, 0, 255}, 1);
            drawText(image_, {kLeft - 28, y - 3}, text, {0, 0, 0, 255}, 1);
        }
    }

    /// `f` of x from 0 to `last`, drawn where it lies between 0 and 1.
    void curve(const std::function<double(double)>& f, double last, const Rgba8& color) {
        constexpr int kDense = 16;
        for (int i = 0; i <= kSide * kDense * last; ++i) {
            const double x = static_cast<double>(i) / (kSide * kDense);
            const double y = f(x);
            if (!(y >= 0 && y <= 1)) continue;
            const glm::ivec2 at(kLeft + std::lround(x * kSide), kTop + kSide - std::lround(y * kSide));
            for (const int thick : {0, 1}) image_.at(at.x, at.y + thick) = color;
        }
    }

    const Image& image() const { return image_; }

  private:
    Image image_;
};

void draw(const CosineFit& fit, const char* name, const Rgba8& color, Plot& plot) {
    plot.curve([&fit](double x) { return std::pow(std::sqrt(1 - x * x), fit.power) - fit.offset; }, 1, color);
    std::cout << name << ": power " << fit.power << ", offset " << fit.offset << ", residual rms " << fit.rms
              << ", largest " << fit.largest << '\n';
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: cosine_fit OUT.png\n";
        return 2;
    }
    try {
        Plot plot;
        const double inner = 1 - kThickness;
        plot.curve([](double x) { return std::sqrt(1 - x * x); }, 1, {150, 150, 150, 255});
        plot.curve([inner](double x) { return std::sqrt(std::max(0.0, inner * inner - x * x)); }, inner,
                   {150, 150, 150, 255});
        draw(fitCosine(kExtinction, kThickness, std::exp(-kExtinction * kThickness)), "the paper's power",
             {40, 70, 220, 255}, plot);
        draw(fitCosine(kExtinction, kThickness), "free power", {30, 150, 50, 255}, plot);
        plot.curve([](double x) { return shellTransmittance(x, kExtinction, kThickness); }, 1,
                   {220, 40, 30, 255});
        writePng(argv[1], plot.image());
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "cosine_fit: " << error.what() << '\n';
        return 1;
    }
}
