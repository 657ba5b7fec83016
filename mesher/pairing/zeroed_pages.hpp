#pragma once
/// An array of zeros of which only the touched parts cost anything. Internal.

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace quadrille {

/// An array of plain values, all bits zero at first. The operating system provides pages only when they are
/// written to: a search over a few thousand of many million triangles spends no time on the others.
template <class Value>
class ZeroedPages {
  static_assert(std::is_trivially_copyable_v<Value>);

 public:
  explicit ZeroedPages(std::size_t size)
      : values_(static_cast<Value*>(std::calloc(size + 1, sizeof(Value)))) {
    if (!values_) throw std::bad_alloc();
  }
  Value& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  struct Free {
    void operator()(Value* memory) const { std::free(memory); }
  };
  std::unique_ptr<Value, Free> values_;
};

}  // namespace quadrille
