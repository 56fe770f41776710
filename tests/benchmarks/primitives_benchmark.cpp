// SPDX-License-Identifier: MIT
// boxwood-benchmark-primitives: the primitives beside std:: and, where it is installed, TBB, on the same data in one
// process. Contenders take turns; medians and ratios are printed and, with --report, written as JSON.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#ifdef BOXWOOD_HAVE_TBB
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_scan.h>
#include <tbb/parallel_sort.h>
#endif

#include "benchmark.hpp"
#include "boxwood/error.hpp"
#include "boxwood/primitives.hpp"
#include "common/median.hpp"
#include "runtime/kernel_text.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

extern const std::vector<KernelText> benchmark_kernels;

namespace {

using Words = std::vector<std::uint32_t>;

struct Pair {
    std::uint32_t key;
    std::uint32_t value;
};
bool by_key(const Pair& a, const Pair& b) { return a.key < b.key; }

/// One way to do the work: `prepare` is not timed, `run` is and returns when the result is there.
struct Contender {
    std::string name;
    std::function<void()> prepare;
    std::function<void()> run;
};

/// Median milliseconds of each contender over `rounds` rounds in which every one has its turn. A turn is two runs from
/// the same input: one that nobody times, which compiles, wakes sleeping threads and brings memory into the caches that
/// the others had in between, and the one that counts.
nlohmann::json race(const std::vector<Contender>& contenders, int rounds) {
    std::vector<std::vector<double>> times(contenders.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            contenders[i].prepare();
            contenders[i].run();
            contenders[i].prepare();
            const auto start = std::chrono::steady_clock::now();
            contenders[i].run();
            const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
            times[i].push_back(taken.count());
        }
    }
    nlohmann::json medians;
    for (std::size_t i = 0; i < contenders.size(); ++i) medians[contenders[i].name] = median(times[i]);
    return medians;
}

void print(const std::string& title, const nlohmann::json& milliseconds) {
    const double ours = milliseconds.at("boxwood");
    std::printf("%s\n", title.c_str());
    for (const auto& [name, ms] : milliseconds.items())
        std::printf("  %-22s %9.3f ms   %6.2f x boxwood's time\n", name.c_str(), ms.get<double>(),
                    ms.get<double>() / ours);
}

Words random_words(std::size_t count) {
    std::mt19937 generator(20260101);
    Words words(count);
    for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(generator());
    return words;
}

const auto nothing = [] {};

class Benchmark {
public:
    Benchmark(Device& device, int rounds) : device_(device), rounds_(rounds) {}

    nlohmann::json sort(std::size_t count);
    nlohmann::json scan(std::size_t count);
    nlohmann::json compact(std::size_t count);
    nlohmann::json reduce(std::size_t count);
    nlohmann::json gather(std::size_t count);

private:
    /// `enqueue` on the device, timed until it is done.
    Contender on_device(const std::string& name, std::function<void()> enqueue) {
        return {name, [this] { device_.finish(); },
                [this, enqueue] {
                    enqueue();
                    device_.finish();
                }};
    }
    Contender copy_kernel(const Buffer<std::uint32_t>& in, Buffer<std::uint32_t>& out) {
        return on_device("copy kernel", [&] {
            const Slices slices = cut(device_, in.size(), 16);
            launch(device_, {"copy.cl", "copy"}, "copy", slices.slices, in, out, static_cast<cl_uint>(in.size()),
                   slices.length, slices.slices);
        });
    }
    Contender copy_command(const Buffer<std::uint32_t>& in, Buffer<std::uint32_t>& out) {
        return on_device("clEnqueueCopyBuffer", [&] { boxwood::copy(device_, in, out); });
    }

    Device& device_;
    int rounds_;
};

nlohmann::json Benchmark::sort(std::size_t count) {
    const Words keys = random_words(count);
    Words positions(count);
    std::iota(positions.begin(), positions.end(), 0u);
    std::vector<Pair> pairs(count), work;
    for (std::size_t i = 0; i < count; ++i) pairs[i] = {keys[i], positions[i]};
    const auto source_keys = upload(device_, keys, "keys"), source_values = upload(device_, positions, "values");
    auto work_keys = make_buffer<std::uint32_t>(device_, count, "keys");
    auto work_values = make_buffer<std::uint32_t>(device_, count, "values");
    const auto copy_pairs = [&] { work = pairs; };

    Contender ours = on_device("boxwood", [&] { radix_sort(device_, work_keys, work_values); });
    ours.prepare = [&] {
        boxwood::copy(device_, source_keys, work_keys);
        boxwood::copy(device_, source_values, work_values);
        device_.finish();
    };
    std::vector<Contender> contenders{
        ours,
        {"std::stable_sort", copy_pairs, [&] { std::stable_sort(work.begin(), work.end(), by_key); }},
        {"std::sort", copy_pairs, [&] { std::sort(work.begin(), work.end(), by_key); }}};
#ifdef BOXWOOD_HAVE_TBB
    contenders.push_back(
        {"tbb::parallel_sort", copy_pairs, [&] { tbb::parallel_sort(work.begin(), work.end(), by_key); }});
#endif
    return race(contenders, rounds_);
}

nlohmann::json Benchmark::scan(std::size_t count) {
    const Words words = random_words(count);
    Words result(count);
    const auto in = upload(device_, words, "words");
    auto out = make_buffer<std::uint32_t>(device_, count, "sums");
    const auto floats = upload(device_, std::vector<float>(words.begin(), words.end()), "floats");
    auto float_sums = make_buffer<float>(device_, count, "sums of floats");
    std::vector<Contender> contenders{
        on_device("boxwood", [&] { exclusive_scan(device_, in, Operator::sum, out); }),
        on_device("boxwood, floats", [&] { exclusive_scan(device_, floats, Operator::sum, float_sums); }),
        copy_kernel(in, out),
        copy_command(in, out),
        {"std::exclusive_scan", nothing,
         [&] { std::exclusive_scan(words.begin(), words.end(), result.begin(), std::uint32_t{0}); }}};
#ifdef BOXWOOD_HAVE_TBB
    contenders.push_back({"tbb::parallel_scan", nothing, [&] {
                              tbb::parallel_scan(
                                  tbb::blocked_range<std::size_t>(0, count), std::uint32_t{0},
                                  [&](const tbb::blocked_range<std::size_t>& range, std::uint32_t sum, bool final) {
                                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                          if (final) result[i] = sum;
                                          sum += words[i];
                                      }
                                      return sum;
                                  },
                                  std::plus<>());
                          }});
#endif
    return race(contenders, rounds_);
}

nlohmann::json Benchmark::compact(std::size_t count) {
    const Words words = random_words(count);
    Words keep(count), result(count);
    for (std::size_t i = 0; i < count; ++i) keep[i] = words[i] >> 31; // half of them, at random
    const auto in = upload(device_, words, "words"), flags = upload(device_, keep, "flags");
    auto out = make_buffer<std::uint32_t>(device_, count, "kept");
    auto total = make_buffer<std::uint32_t>(device_, 1, "count");
    std::vector<Contender> contenders{on_device("boxwood", [&] { boxwood::compact(device_, in, flags, out, total); }),
                                      copy_kernel(in, out),
                                      copy_command(in, out),
                                      {"std::copy_if", nothing, [&] {
                                           std::size_t i = 0;
                                           std::copy_if(words.begin(), words.end(), result.begin(),
                                                        [&](std::uint32_t) { return keep[i++] != 0; });
                                       }}};
#ifdef BOXWOOD_HAVE_TBB
    contenders.push_back({"tbb::parallel_scan", nothing, [&] {
                              tbb::parallel_scan(
                                  tbb::blocked_range<std::size_t>(0, count), std::size_t{0},
                                  [&](const tbb::blocked_range<std::size_t>& range, std::size_t place, bool final) {
                                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                          if (final && keep[i]) result[place] = words[i];
                                          place += keep[i];
                                      }
                                      return place;
                                  },
                                  std::plus<>());
                          }});
#endif
    return race(contenders, rounds_);
}

nlohmann::json Benchmark::reduce(std::size_t count) {
    const Words words = random_words(count);
    const auto in = upload(device_, words, "words");
    auto out = make_buffer<std::uint32_t>(device_, 1, "sum");
    volatile std::uint32_t sink = 0;
    std::vector<Contender> contenders{
        on_device("boxwood", [&] { boxwood::reduce(device_, in, Operator::sum, out); }),
        {"std::reduce", nothing, [&] { sink = std::reduce(words.begin(), words.end(), std::uint32_t{0}); }}};
#ifdef BOXWOOD_HAVE_TBB
    contenders.push_back(
        {"tbb::parallel_reduce", nothing, [&] {
             sink = tbb::parallel_reduce(
                 tbb::blocked_range<const std::uint32_t*>(words.data(), words.data() + count), std::uint32_t{0},
                 [](const auto& range, std::uint32_t sum) { return std::reduce(range.begin(), range.end(), sum); },
                 std::plus<>());
         }});
#endif
    return race(contenders, rounds_);
}

nlohmann::json Benchmark::gather(std::size_t count) {
    const Words words = random_words(count);
    Words places(count), result(count);
    for (std::size_t i = 0; i < count; ++i)
        places[i] = static_cast<std::uint32_t>(std::uint64_t{words[i]} * count >> 32);
    const auto in = upload(device_, words, "words"), indices = upload(device_, places, "indices");
    auto out = make_buffer<std::uint32_t>(device_, count, "gathered");
    return race({on_device("boxwood", [&] { boxwood::gather(device_, in, indices, out); }),
                 {"std::transform", nothing,
                  [&] {
                      std::transform(places.begin(), places.end(), result.begin(),
                                     [&](std::uint32_t place) { return words[place]; });
                  }}},
                rounds_);
}

/// Share of the bandwidth of a copy of `copied` words that moving `moved` useful words reached.
double share_of_copy(const nlohmann::json& ms, double moved, double copied) {
    const double copy = std::min(ms.at("copy kernel").get<double>(), ms.at("clEnqueueCopyBuffer").get<double>());
    return (moved / ms.at("boxwood").get<double>()) / (2.0 * copied / copy);
}

int run(int argc, char** argv) {
    CLI::App app("Times the primitives beside std:: and TBB.");
    benchmarks::Arguments arguments;
    benchmarks::add_arguments(app, arguments);
    CLI11_PARSE(app, argc, argv);

    Device device(arguments.device);
    add_kernels(benchmark_kernels);
    Benchmark benchmark(device, arguments.rounds);
    constexpr std::size_t pairs = 1000000, words = std::size_t{64} << 18; // 64 MiB of uint
    nlohmann::json milliseconds, ratios;
    std::printf("device: %s\nmedians of %d alternating runs, each after one that is not timed\n\n",
                device.info().name.c_str(), arguments.rounds);

    print("radix sort, 1,000,000 random 32-bit pairs", milliseconds["sort"] = benchmark.sort(pairs));
    print("exclusive scan, 64 MiB of uint", milliseconds["scan"] = benchmark.scan(words));
    print("compact, 64 MiB of uint, half kept at random", milliseconds["compact"] = benchmark.compact(words));
    print("reduce, 64 MiB of uint", milliseconds["reduce"] = benchmark.reduce(words));
    print("gather, 64 MiB of uint, random", milliseconds["gather"] = benchmark.gather(words));

    const double sort_ms = milliseconds["sort"]["boxwood"];
    ratios["sort_against_stable_sort"] = milliseconds["sort"]["std::stable_sort"].get<double>() / sort_ms;
    // A scan usefully moves n words in and n out; a compaction n elements and n flags in and n / 2 out.
    const auto n = static_cast<double>(words);
    ratios["scan_share_of_copy_bandwidth"] = share_of_copy(milliseconds["scan"], 2.0 * n, n);
    ratios["compact_share_of_copy_bandwidth"] = share_of_copy(milliseconds["compact"], 2.5 * n, n);
    std::printf("\nratios\n");
    for (const auto& [name, ratio] : ratios.items()) std::printf("  %-34s %6.2f\n", name.c_str(), ratio.get<double>());

    benchmarks::save_report(arguments, device.info(), milliseconds, ratios);
    return 0;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-primitives", [&] { return boxwood::run(argc, argv); });
}
