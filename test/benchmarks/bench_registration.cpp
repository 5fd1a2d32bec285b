// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// pcl::ScanRegistration beside PCL's ICP, ICP with normals, GICP and NDT on pairs of
// scans with a known motion: accuracy and time from good guesses, and how many of ever
// rougher guesses come home. One thread each.

#include "registration_methods.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <random>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::bench;
using benchmark::State;

constexpr int kGoodStarts = 2; // per pair
constexpr int kRoughStarts = 2;
/** Rough guesses are off by so many times a good one's error. */
constexpr int kRoughFactors[] = {5, 10, 20};

/** A motion of given length and angle in random directions. */
Eigen::Isometry3d
randomMotion(double translation, double rotation, std::mt19937& random)
{
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, 3, 2> axes;
  for (double& value : axes.reshaped())
    value = normal(random);
  Tangent tangent;
  tangent << translation * axes.col(0).normalized(),
      rotation * axes.col(1).normalized();
  return exponential(tangent);
}

struct PairError {
  double translation;
  double rotation;
};

PairError
errorOf(const Eigen::Isometry3d& truth, const Eigen::Isometry3d& pose)
{
  const Eigen::Isometry3d left = truth.inverse() * pose;
  return {left.translation().norm(), Eigen::AngleAxisd(left.linear()).angle()};
}

/** Aligns all pairs from so many starts each at a multiple of a good guess's error. */
std::vector<PairError>
alignAll(Method method, const PairSet& set, double factor, int starts)
{
  std::mt19937 random(static_cast<unsigned>(factor));
  std::vector<PairError> errors;
  for (const ScanPair& pair : set.pairs)
    for (int i = 0; i < starts; ++i) {
      const Eigen::Isometry3d guess =
          pair.truth * randomMotion(factor * set.guess_translation,
                                    factor * set.guess_rotation,
                                    random);
      errors.push_back(errorOf(pair.truth, align(method, set, pair, guess)));
    }
  return errors;
}

/** The pairs of a row, read once for all methods. */
const PairSet&
pairsOf(const std::string& name)
{
  static std::map<std::string, PairSet> known;
  const auto found = known.find(name);
  return found != known.end() ? found->second
                              : known.emplace(name, pairSet(name)).first->second;
}

double
median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void
accuracy(State& state, const std::string& name, Method method)
{
  const PairSet& set = pairsOf(name);
  if (set.pairs.empty())
    return state.SkipWithError("the data set is not there");
  std::vector<PairError> errors;
  for (auto _ : state)
    errors = alignAll(method, set, 1.0, kGoodStarts);
  std::vector<double> translations;
  std::vector<double> rotations;
  for (const PairError& error : errors) {
    translations.push_back(1e3 * error.translation);
    rotations.push_back(1e3 * error.rotation);
  }
  state.counters["calls"] = static_cast<double>(errors.size());
  state.counters["error_mm"] = median(translations);
  state.counters["error_mrad"] = median(rotations);
  state.counters["worst_mm"] =
      *std::max_element(translations.begin(), translations.end());
}

void
basin(State& state, const std::string& name, Method method)
{
  const PairSet& set = pairsOf(name);
  if (set.pairs.empty())
    return state.SkipWithError("the data set is not there");
  for (auto _ : state)
    for (const int factor : kRoughFactors) {
      const auto errors = alignAll(method, set, factor, kRoughStarts);
      const auto home = std::count_if(errors.begin(), errors.end(), [&](auto& error) {
        return error.translation <= set.home_translation &&
               error.rotation <= set.home_rotation;
      });
      state.counters["home_percent_" + std::to_string(factor)] =
          100.0 * static_cast<double>(home) / static_cast<double>(errors.size());
    }
  state.counters["calls"] =
      static_cast<double>(std::size(kRoughFactors) * set.pairs.size() * kRoughStarts);
}

const bool kRegistered = [] {
  for (const std::string& name : pairSetNames())
    for (std::size_t i = 0; i < methodNames().size(); ++i) {
      const auto method = static_cast<Method>(i);
      const std::string& kernel = methodNames()[i];
      benchmark::RegisterBenchmark(("register_" + name + "/" + kernel).c_str(),
                                   [=](State& state) { accuracy(state, name, method); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1);
      benchmark::RegisterBenchmark(("register_basin_" + name + "/" + kernel).c_str(),
                                   [=](State& state) { basin(state, name, method); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1);
    }
  return true;
}();

} // namespace
