// SPDX-License-Identifier: BSD-3-Clause
// WorkerPool: lends copies of an object that changes while it works, so that several threads may call one Python
// object.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace hinge::python {

/// Owns workers. A call borrows one and returns it at its end; if all are lent, a further copy is made. The number of
/// workers is the largest number that was lent at one time.
template <class Worker>
class WorkerPool {
 public:
  explicit WorkerPool(Worker first) : prototype_(std::move(first)) {}

  /// A worker on loan.
  class Loan {
   public:
    explicit Loan(WorkerPool& pool) : pool_(pool), worker_(pool.take()) {}
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    ~Loan() { pool_.give_back(std::move(worker_)); }
    Worker& operator*() { return *worker_; }
    Worker* operator->() { return worker_.get(); }

   private:
    WorkerPool& pool_;
    std::unique_ptr<Worker> worker_;
  };

  /// Makes one worker, so that the first call need not.
  void make_one() { const Loan loan(*this); }
  /// The object that workers are copies of. It is never lent, so many threads may read it at once.
  const Worker& prototype() const noexcept { return prototype_; }

 private:
  std::unique_ptr<Worker> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        std::unique_ptr<Worker> worker = std::move(free_.back());
        free_.pop_back();
        return worker;
      }
      free_.reserve(++made_);  // so that give_back() needs no memory
    }
    return std::make_unique<Worker>(prototype_);
  }
  void give_back(std::unique_ptr<Worker> worker) noexcept {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(worker));
  }

  const Worker prototype_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> free_;
  std::size_t made_ = 0;
};

}  // namespace hinge::python
