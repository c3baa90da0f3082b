#pragma once
// What is worth keeping: the few things used last.

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <utility>

namespace curvewall {

template <class Key, class Value>
class RecentlyUsed {
public:
    explicit RecentlyUsed(size_t most) : most_(most) {}

    // The value of the key, null where it is not there.
    std::shared_ptr<Value> find(const Key& key) {
        const auto found = std::ranges::find(entries_, key, &Entry::key);
        if (found == entries_.end()) return nullptr;
        std::rotate(entries_.begin(), found, found + 1);
        return entries_.front().value;
    }

    // The value of the key, made where it is not there. Room is made first, so that there are never more than
    // `most`, but for those that somebody still holds.
    std::shared_ptr<Value> get(const Key& key, const std::function<std::shared_ptr<Value>()>& make) {
        if (std::shared_ptr<Value> value = find(key)) return value;
        if (entries_.size() >= most_) entries_.pop_back();
        entries_.push_front({key, make()});
        return entries_.front().value;
    }

    // Also in the place of another value.
    void put(const Key& key, std::shared_ptr<Value> value) {
        if (find(key))
            entries_.front().value = std::move(value);
        else
            get(key, [&] { return std::move(value); });
    }

private:
    struct Entry {
        Key key;
        std::shared_ptr<Value> value;
    };
    size_t most_;
    std::deque<Entry> entries_;  // the last used first
};

}  // namespace curvewall
