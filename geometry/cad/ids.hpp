#pragma once
/// Identifiers of the faces, edges and vertices of a CAD model. They do not mix: with plain integers, an edge
/// in place of a face, or a number from 1 in place of an index from 0, compiles.

#include <compare>
#include <cstddef>
#include <functional>
#include <ranges>
#include <utility>
#include <vector>

namespace quadrille {

/// Identifies a face, edge or vertex. Compared and sorted in the order of the model.
template <class Kind>
class Id {
 public:
  constexpr Id() = default;  ///< none

  /// \param index from 0.
  template <class Integer>
  static constexpr Id from_index(Integer index) {
    return Id(static_cast<int>(index));
  }
  /// \param number from 1, as in FreeCAD's Face1, Edge1, Vertex1; 0 = none.
  static constexpr Id from_number(int number) { return Id(number - 1); }

  constexpr int index() const { return index_; }       ///< from 0; -1 = none
  constexpr int number() const { return index_ + 1; }  ///< from 1; 0 = none
  constexpr bool exists() const { return index_ >= 0; }

  friend constexpr auto operator<=>(const Id&, const Id&) = default;

 private:
  explicit constexpr Id(int index) : index_(index) {}

  int index_ = -1;
};

using FaceId = Id<struct FaceKind>;
using EdgeId = Id<struct EdgeKind>;
using VertexId = Id<struct VertexKind>;

/// A value for each face, edge or vertex, found by its id.
template <class Id, class Value>
class IdVector {
 public:
  IdVector() = default;
  explicit IdVector(std::size_t size, const Value& value = {}) : values_(size, value) {}
  explicit IdVector(std::vector<Value> values) : values_(std::move(values)) {}

  decltype(auto) operator[](Id id) { return values_[id.index()]; }
  decltype(auto) operator[](Id id) const { return values_[id.index()]; }

  /// The ids of all values, ascending.
  auto ids() const {
    return std::views::iota(0, static_cast<int>(values_.size())) |
           std::views::transform([](int index) { return Id::from_index(index); });
  }
  /// The id that the next value gets.
  Id next() const { return Id::from_index(values_.size()); }

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  void reserve(std::size_t size) { values_.reserve(size); }
  void resize(std::size_t size, const Value& value = {}) { values_.resize(size, value); }
  void assign(std::size_t size, const Value& value) { values_.assign(size, value); }
  Id push_back(Value value) {
    values_.push_back(std::move(value));
    return Id::from_index(values_.size() - 1);
  }

  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

  const std::vector<Value>& values() const { return values_; }  ///< in the order of the ids

  friend bool operator==(const IdVector&, const IdVector&) = default;

 private:
  std::vector<Value> values_;
};

/// A property of each face, edge or vertex: 1 = it has it.
using FaceFlags = IdVector<FaceId, char>;
using EdgeFlags = IdVector<EdgeId, char>;
using VertexFlags = IdVector<VertexId, char>;

}  // namespace quadrille

template <class Kind>
struct std::hash<quadrille::Id<Kind>> {
  std::size_t operator()(quadrille::Id<Kind> id) const noexcept { return std::hash<int>()(id.index()); }
};
