#pragma once
/// Identifiers of the faces, edges and vertices of a CAD model. As separate types, they let the compiler
/// reject an edge in place of a face, or a number from 1 in place of an index from 0.

#include <compare>
#include <cstddef>
#include <iterator>
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

  constexpr int index() const { return index_; }         ///< from 0; -1 = none
  constexpr int number() const { return index_ + 1; }    ///< from 1; 0 = none
  constexpr bool exists() const { return index_ >= 0; }  ///< whether it identifies anything

  /// By index; none comes first.
  friend constexpr auto operator<=>(const Id&, const Id&) = default;  // NOLINT(modernize-use-nullptr)

 private:
  explicit constexpr Id(int index) : index_(index) {}

  int index_ = -1;
};

using FaceId = Id<struct FaceKind>;      ///< a face
using EdgeId = Id<struct EdgeKind>;      ///< an edge
using VertexId = Id<struct VertexKind>;  ///< a vertex

/// The first so many ids, ascending. A class of our own in place of std::views, which clang-tidy 14 cannot
/// read.
template <class Id>
class IdRange {
 public:
  /// Ids come by value, so by the rules of C++17 these are input iterators, though they can be copied and
  /// reread.
  class Iterator {
   public:
    using iterator_concept = std::forward_iterator_tag;  ///< as in C++20
    using iterator_category = std::input_iterator_tag;   ///< as in C++17
    using value_type = Id;                               ///< as standard iterators
    using difference_type = std::ptrdiff_t;              ///< as standard iterators
    using pointer = void;                                ///< as standard iterators
    using reference = Id;                                ///< as standard iterators

    constexpr Iterator() = default;                                    ///< of no range
    explicit constexpr Iterator(int index) : index_(index) {}          ///< at the id of this index
    constexpr Id operator*() const { return Id::from_index(index_); }  ///< the id here
    /// The next id.
    constexpr Iterator& operator++() {
      ++index_;
      return *this;
    }
    constexpr Iterator operator++(int) { return Iterator(index_++); }  ///< the next id; returns the old place
    friend constexpr bool operator==(const Iterator&, const Iterator&) = default;  ///< by place

   private:
    int index_ = 0;
  };

  explicit constexpr IdRange(std::size_t size) : size_(static_cast<int>(size)) {}  ///< the first `size` ids

  constexpr Iterator begin() const { return Iterator(0); }    ///< at the first id
  constexpr Iterator end() const { return Iterator(size_); }  ///< past the last id

 private:
  int size_;
};

/// A value for each face, edge or vertex, found by its id.
template <class Id, class Value>
class IdVector {
 public:
  IdVector() = default;
  explicit IdVector(std::size_t size) : values_(size) {}                    ///< value-initialized
  IdVector(std::size_t size, const Value& value) : values_(size, value) {}  ///< the same value for all

  decltype(auto) operator[](Id id) { return values_[id.index()]; }        ///< the id must exist
  decltype(auto) operator[](Id id) const { return values_[id.index()]; }  ///< the id must exist

  /// The ids of all values, ascending.
  IdRange<Id> ids() const { return IdRange<Id>(values_.size()); }

  std::size_t size() const { return values_.size(); }      ///< number of values
  bool empty() const { return values_.empty(); }           ///< whether there are none
  void resize(std::size_t size) { values_.resize(size); }  ///< as std::vector::resize()
  /// As std::vector::assign().
  void assign(std::size_t size, const Value& value) { values_.assign(size, value); }
  void reserve(std::size_t size) { values_.reserve(size); }  ///< as std::vector::reserve()
  /// Adds a value. \return its id
  Id push_back(Value value) {
    values_.push_back(std::move(value));
    return Id::from_index(values_.size() - 1);
  }

  auto begin() { return values_.begin(); }        ///< the values in the order of their ids
  auto end() { return values_.end(); }            ///< the end of the values
  auto begin() const { return values_.begin(); }  ///< the values in the order of their ids
  auto end() const { return values_.end(); }      ///< the end of the values

 private:
  std::vector<Value> values_;
};

using FaceFlags = IdVector<FaceId, char>;      ///< a property of faces: 1 = the face has it
using EdgeFlags = IdVector<EdgeId, char>;      ///< a property of edges: 1 = the edge has it
using VertexFlags = IdVector<VertexId, char>;  ///< a property of vertices: 1 = the vertex has it

/// Whether a face, edge or vertex has a property; where there are no flags, none has it.
template <class Id>
bool is_set(const IdVector<Id, char>& flags, Id id) {
  return !flags.empty() && flags[id] != 0;
}

}  // namespace quadrille
