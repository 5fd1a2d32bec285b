// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/maximum_clique.h>

#include <gtest/gtest.h>

#include <random>

using namespace pcl::nurbs;

namespace {

NeighbourSets
randomGraph(std::size_t size, double density, unsigned seed)
{
  std::mt19937 generator(seed);
  std::bernoulli_distribution joined(density);
  NeighbourSets sets(size, boost::dynamic_bitset<>(size));
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = i + 1; j < size; ++j)
      sets[i][j] = sets[j][i] = joined(generator);
  return sets;
}

bool
isClique(const NeighbourSets& graph, const std::vector<std::size_t>& vertices)
{
  for (const std::size_t a : vertices)
    for (const std::size_t b : vertices)
      if (a != b && !graph[a][b])
        return false;
  return true;
}

/** Over all subsets. */
std::size_t
largestByTrial(const NeighbourSets& graph)
{
  std::size_t best = 0;
  for (std::size_t subset = 0; subset < (std::size_t{1} << graph.size()); ++subset) {
    std::vector<std::size_t> vertices;
    for (std::size_t v = 0; v < graph.size(); ++v)
      if ((subset >> v & 1U) != 0)
        vertices.push_back(v);
    if (vertices.size() > best && isClique(graph, vertices))
      best = vertices.size();
  }
  return best;
}

} // namespace

TEST(MaximumClique, isAsLargeAsTrialFinds)
{
  for (unsigned seed = 0; seed < 40; ++seed)
    for (const double density : {0.2, 0.5, 0.8}) {
      const NeighbourSets graph = randomGraph(1 + seed % 13, density, seed);
      const MaximumClique clique = maximumClique(graph);
      EXPECT_TRUE(clique.proven);
      EXPECT_TRUE(isClique(graph, clique.vertices));
      EXPECT_EQ(clique.vertices.size(), largestByTrial(graph));
    }
}

TEST(MaximumClique, hiddenCliqueIsFound)
{
  NeighbourSets graph = randomGraph(150, 0.3, 7);
  std::vector<std::size_t> hidden;
  for (std::size_t v = 3; v < 150; v += 7)
    hidden.push_back(v);
  for (const std::size_t a : hidden)
    for (const std::size_t b : hidden)
      if (a != b)
        graph[a][b] = true;
  const MaximumClique clique = maximumClique(graph);
  EXPECT_TRUE(clique.proven);
  EXPECT_EQ(clique.vertices, hidden);
}

TEST(MaximumClique, endsAfterSoManySteps)
{
  const NeighbourSets graph = randomGraph(200, 0.9, 3);
  const MaximumClique clique = maximumClique(graph, 10);
  EXPECT_FALSE(clique.proven);
  EXPECT_TRUE(isClique(graph, clique.vertices));
  EXPECT_GT(clique.vertices.size(), 10U);
}

TEST(MaximumClique, noVertices)
{
  EXPECT_TRUE(maximumClique({}).vertices.empty());
}

TEST(MaximumClique, badGraphsAreRefused)
{
  NeighbourSets one_sided(2, boost::dynamic_bitset<>(2));
  one_sided[0][1] = true;
  EXPECT_THROW(maximumClique(one_sided), std::invalid_argument);
  NeighbourSets own(1, boost::dynamic_bitset<>(1));
  own[0][0] = true;
  EXPECT_THROW(maximumClique(own), std::invalid_argument);
  EXPECT_THROW(maximumClique(NeighbourSets(2, boost::dynamic_bitset<>(3))),
               std::invalid_argument);
}
