#pragma once
// See parallel_for.h. The loops of a job start threads of their own, so an arena bounds nothing.

namespace tbb {

class task_arena {
  public:
    explicit task_arena(int) {}
    void initialize() {}
    template <class Body>
    void execute(const Body& body) {
        body();
    }
};

namespace this_task_arena {

inline int max_concurrency() { return 1; }

template <class Body>
void isolate(const Body& body) {
    body();
}

} // namespace this_task_arena

} // namespace tbb
