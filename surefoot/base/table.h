#pragma once
// Values that never change once they are there, in one piece: a table shares what it owns with its copies, or points at
// memory that outlives it (an opened pack, pack_file/pack.h). Copying one copies no values.

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace surefoot {

template <typename T>
class Table {
  public:
    Table() = default;
    Table(std::vector<T> values)  // NOLINT: values are a table
        : owner_(std::make_shared<const std::vector<T>>(std::move(values))), view_(*owner_) {}
    Table(std::initializer_list<T> values) : Table(std::vector<T>(values)) {}
    /// Of values that lie elsewhere and outlive the table and its copies.
    static Table of(std::span<const T> values) noexcept {
        Table table;
        table.view_ = values;
        return table;
    }

    const T* data() const noexcept { return view_.data(); }
    std::size_t size() const noexcept { return view_.size(); }
    bool empty() const noexcept { return view_.empty(); }
    const T& operator[](std::size_t i) const noexcept { return view_[i]; }
    const T& front() const noexcept { return view_.front(); }
    const T& back() const noexcept { return view_.back(); }
    const T* begin() const noexcept { return view_.data(); }
    const T* end() const noexcept { return view_.data() + view_.size(); }
    operator std::span<const T>() const noexcept { return view_; }  // NOLINT: a table is a span of values

    /// For who builds: the values as a vector that may be changed and made a table again.
    std::vector<T> values() const { return {begin(), end()}; }
    /// Lets `change` have its way with the values.
    template <typename Change>
    void edit(Change change) {
        std::vector<T> edited = values();
        change(edited);
        *this = Table(std::move(edited));
    }

    friend bool operator==(const Table& a, const Table& b) noexcept {
        return std::equal(a.begin(), a.end(), b.begin(), b.end());
    }

  private:
    std::shared_ptr<const std::vector<T>> owner_;
    std::span<const T> view_;
};

}  // namespace surefoot
