// SPDX-License-Identifier: MIT
#include "build/morton_runs.hpp"

#include <utility>

#include "boxwood/gather.hpp"
#include "boxwood/radix_sort.hpp"
#include "boxwood/scan.hpp"
#include "boxwood/scatter.hpp"
#include "build/trees.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

template <class Key>
KernelRef kernel(const char* name, KeyFormat format, std::size_t trees) {
    return {"build/morton_runs.cl",
            name,
            {{"KEY", sizeof(Key) == 4 ? "uint" : "ulong"},
             {"TREE_IN_KEY", trees > 1 ? "1" : "0"},
             {"CODE_BITS", std::to_string(format.code_bits)}}};
}

/// The members of long runs among sorted keys, run by run.
struct LongRuns {
    Buffer<std::uint32_t> members; ///< Their indices among the keys.
    Buffer<std::uint32_t> starts;  ///< Where each run begins in `members`, and where the last ends.
};

/// Nothing when there is no long run. `later`: what is a run from end to end of its tree cannot be parted.
template <class Key>
LongRuns find_long_runs(Device& device, BufferView<const Key> keys, KeyFormat format,
                        BufferView<const std::uint32_t> offsets, bool later) {
    LongRuns runs;
    if (keys.size() < long_run) return runs;
    const auto count = static_cast<std::uint32_t>(keys.size());
    const std::uint32_t whole_trees = later ? 0 : 1;
    const std::size_t trees = offsets.size() - 1;
    const Slices slices = cut(device, count);
    auto all_counts = make_scratch<std::uint64_t>(device, most_slices(device, count), "counts of runs");
    const BufferView<std::uint64_t> counts = all_counts.prefix(slices.slices);
    launch(device, kernel<Key>("count_runs", format, trees), "count runs", slices.slices, keys, offsets, counts,
           long_run, whole_trees, count, slices.length);
    inclusive_scan(device, counts, Operator::sum, counts);
    const std::uint64_t sums = download_element(device, all_counts, slices.slices - 1);
    if (sums == 0) return runs;
    runs.members = make_scratch<std::uint32_t>(device, static_cast<std::uint32_t>(sums), "members of runs");
    runs.starts = make_scratch<std::uint32_t>(device, (sums >> 32) + 1, "starts of runs");
    launch(device, kernel<Key>("list_runs", format, trees), "list runs", slices.slices, keys, offsets, counts,
           runs.members, runs.starts, long_run, whole_trees, count, slices.length);
    return runs;
}

/// What a later round leaves for the next.
struct Round {
    Buffer<std::uint64_t> keys;
    KeyFormat format;
    Buffer<std::uint32_t> places; ///< The position of each key.
    Buffer<std::uint32_t> starts; ///< Of its runs, which are the trees of its keys.
};

Buffer<std::uint32_t> gathered(Device& device, BufferView<const std::uint32_t> in,
                               BufferView<const std::uint32_t> indices, const char* label) {
    Buffer<std::uint32_t> out = make_scratch<std::uint32_t>(device, indices.size(), label);
    gather(device, in, indices, out);
    return out;
}

/// Sorts the primitives at round.places within each run by codes of their own, and leaves the keys in `round`.
void sort_runs(Device& device, BufferView<const Aabb> boxes, BufferView<std::uint32_t> order, Round& round) {
    const auto primitives = gathered(device, order, round.places, "primitives of runs");
    const std::size_t count = primitives.size();
    round.keys = make_scratch<std::uint64_t>(device, count, "keys of runs");
    auto sorted = make_scratch<std::uint32_t>(device, count, "order in runs");
    {
        auto centres = make_scratch<Aabb>(device, count, "centres of runs");
        const Slices slices = cut(device, count);
        launch(device, kernel<std::uint64_t>("run_centres", round.format, round.starts.size() - 1), "centres of runs",
               slices.slices, boxes, primitives, centres, static_cast<std::uint32_t>(count), slices.length);
        const Buffer<Aabb> bounds = bounds_of_trees(device, centres, round.starts);
        morton_keys(device, centres, round.starts, bounds, round.format, round.keys, sorted);
    }
    radix_sort(device, round.keys, sorted, 0, round.format.key_bits);
    scatter(device, gathered(device, primitives, sorted, "sorted primitives of runs"), round.places, order);
}

} // namespace

template <class Key>
void partition_long_runs(Device& device, BufferView<const Aabb> boxes, BufferView<const Key> keys, KeyFormat format,
                         BufferView<const std::uint32_t> offsets, BufferView<std::uint32_t> order,
                         BufferView<Gap> gaps) {
    LongRuns runs = find_long_runs<Key>(device, keys, format, offsets, false);
    Round round;
    for (std::uint32_t number = 1; runs.members.size() > 0 && number < most_rounds; ++number) {
        round.places =
            number == 1 ? std::move(runs.members) : gathered(device, round.places, runs.members, "places of runs");
        round.starts = std::move(runs.starts);
        round.format = key_format(MortonBits::bits30, round.starts.size() - 1);
        sort_runs(device, boxes, order, round);
        const auto count = static_cast<std::uint32_t>(round.keys.size());
        const Slices slices = cut(device, count);
        launch(device, kernel<std::uint64_t>("run_gaps", round.format, round.starts.size() - 1), "gaps in runs",
               slices.slices, round.keys, round.places, gaps, gap_rank(number), count, slices.length);
        runs = find_long_runs<std::uint64_t>(device, round.keys, round.format, round.starts, true);
    }
}

template void partition_long_runs<std::uint32_t>(Device&, BufferView<const Aabb>, BufferView<const std::uint32_t>,
                                                 KeyFormat, BufferView<const std::uint32_t>, BufferView<std::uint32_t>,
                                                 BufferView<Gap>);
template void partition_long_runs<std::uint64_t>(Device&, BufferView<const Aabb>, BufferView<const std::uint64_t>,
                                                 KeyFormat, BufferView<const std::uint32_t>, BufferView<std::uint32_t>,
                                                 BufferView<Gap>);

} // namespace boxwood
