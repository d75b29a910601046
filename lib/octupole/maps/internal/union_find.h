#pragma once

#include <numeric>
#include <utility>
#include <vector>

namespace octupole::internal {

/// Disjoint sets of 0..size - 1, each with a bit of parity relative to its root.
class UnionFind {
 public:
  explicit UnionFind(int size) : parent_(size), parity_(size, false) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The root of x and the parity of x to it.
  std::pair<int, bool> Find(int x) {
    int root = x;
    bool parity = false;
    while (parent_[root] != root) {
      parity ^= parity_[root];
      root = parent_[root];
    }
    for (bool rest = parity; parent_[x] != root && x != root;) {
      const int next = parent_[x];
      const bool step = parity_[x];
      parent_[x] = root;
      parity_[x] = rest;
      rest ^= step;
      x = next;
    }
    return {root, parity};
  }

  int Root(int x) { return Find(x).first; }

  /// Joins the sets of x and y, between which `parity` lies; the smaller root remains. Nothing happens where they are
  /// one set already.
  void Unite(int x, int y, bool parity = false) {
    auto [root_x, parity_x] = Find(x);
    auto [root_y, parity_y] = Find(y);
    if (root_x == root_y) return;
    if (root_y < root_x) std::swap(root_x, root_y);
    parent_[root_y] = root_x;
    parity_[root_y] = parity_x ^ parity_y ^ parity;
  }

 private:
  std::vector<int> parent_;
  std::vector<bool> parity_;
};

}  // namespace octupole::internal
