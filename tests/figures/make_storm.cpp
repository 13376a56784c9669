// A generated thunderstorm in the format and size of libMini's: 21 PVM files of 28 x 28 x 23 bytes.
//
//     make_storm FOLDER

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

namespace {

constexpr int kWidth = 28;
constexpr int kHeight = 23;
constexpr int kSteps = 21;

double bell(double distance, double width) {
    return std::exp(-distance * distance / (width * width));
}

/// Cloud water at x, y in [-1,1], height z and time t in [0,1]: a leaning tower that grows into an anvil.
double cloud(double x, double y, double z, double t) {
    const double top = 0.35 + 0.5 * t;
    const double dx = x + 0.1 - 0.25 * std::sin(3 * z + 4 * t);
    const double dy = y + 0.2 - 0.20 * std::cos(2.3 * z - 3 * t);
    const double radius = std::hypot(dx, dy);
    const double tower = bell(radius, 0.22 + 0.15 * z) / (1 + std::exp((z - top) * 30));
    const double anvil = 0.7 * t * bell(z - top, 0.11) * bell(radius, 0.35 + 0.45 * t);
    const double cell = 0.8 * t * bell(std::hypot(x - 0.6, y + 0.5), 0.2) * bell(z - 0.3, 0.25);
    return tower + anvil + cell;
}

void writeStep(const std::filesystem::path& file, double t) {
    std::ofstream out(file, std::ios::binary);
    out << "PVM\n" << kWidth << ' ' << kWidth << ' ' << kHeight << "\n1\n";
    for (int k = 0; k < kHeight; ++k) {
        for (int j = 0; j < kWidth; ++j) {
            for (int i = 0; i < kWidth; ++i) {
                const double value = cloud(2.0 * i / (kWidth - 1) - 1, 2.0 * j / (kWidth - 1) - 1,
                                           static_cast<double>(k) / (kHeight - 1), t);
                out.put(static_cast<char>(std::clamp(std::lround(255 * value), 0L, 255L)));
            }
        }
    }
    if (!out.flush()) throw std::filesystem::filesystem_error("cannot write", file, std::error_code());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: make_storm FOLDER\n";
        return 2;
    }
    try {
        std::filesystem::create_directories(argv[1]);
        for (int step = 0; step < kSteps; ++step) {
            char name[32];
            std::snprintf(name, sizeof name, "Storm.pvm-t%02d", step + 1);
            writeStep(std::filesystem::path(argv[1]) / name, step / (kSteps - 1.0));
        }
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "make_storm: " << error.what() << '\n';
        return 1;
    }
}
