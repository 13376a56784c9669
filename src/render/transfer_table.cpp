#include "render/transfer_table.h"

#include <algorithm>
#include <cmath>

namespace isoglass {

TransferTable makeTransferTable(const VolumeStyle& style) {
    TransferTable table;
    const double low = std::min(style.colors.front().value, style.opacities.front().value);
    const double high = std::max(style.colors.back().value, style.opacities.back().value);
    constexpr int kLast = TransferTable::kEntries - 1;
    table.low = static_cast<float>(low);
    table.scale = high > low ? static_cast<float>(kLast / (high - low)) : 0;
    for (int i = 0; i <= kLast; ++i)
        table.entries.push_back(transferAt(style, low + (high - low) * i / kLast));
    constexpr int kBins = TransferTable::kBins;
    // Of the entries that the bin touches.
    std::vector<bool> binShows(kBins);
    for (int bin = 0; bin < kBins; ++bin) {
        const int first = bin * kLast / kBins;
        const int last = std::min(((bin + 1) * kLast + kBins - 1) / kBins, kLast);
        for (int i = first; i <= last; ++i)
            binShows[static_cast<std::size_t>(bin)] =
                binShows[static_cast<std::size_t>(bin)] || table.entries[static_cast<std::size_t>(i)].a > 0;
    }
    for (int a = 0; a < kBins; ++a) {
        bool any = false;
        for (int b = 0; b < kBins; ++b) {
            any = b >= a && (any || binShows[static_cast<std::size_t>(b)]);
            table.visible.push_back(any ? 1.0f : 0.0f);
        }
    }
    return table;
}

}  // namespace isoglass
