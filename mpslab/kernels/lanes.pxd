# Four doubles that are worked on together: a vector and one more number (see lanes.h).

cdef extern from "lanes.h" nogil:
    ctypedef struct four:
        pass

    four nothing() noexcept
    four load(const double* row) noexcept
    four widened(const float* row) noexcept
    void store(double* row, four v) noexcept
    void store_rounded(float* row, four v) noexcept
    double lane(four v, int axis) noexcept
    four ended(four v, double x) noexcept
    four same(double x) noexcept
    four minus(four a, four b) noexcept
    four product(four a, four b) noexcept
    four quotient(four a, four b) noexcept
    four at_least(double x, four v) noexcept
    four root(four v) noexcept
    double added(four v) noexcept
    four times(double factor, four v) noexcept
    four plus(four total, double factor, four v) noexcept
    four nearest(four v, double width) noexcept
    int near_eight(const double* xs, const double* ys, const double* zs, double x, double y,
                   double z, double limit, double width) noexcept
    int reached_eight(const float* inverse, const int* other, const float* reach, float mine,
                      long count) noexcept
    void prepare_squeeze() noexcept
    int squeeze(int* to, const int* numbers, int choice) noexcept
    double row_of_singles(const float* value, const int* place, const double* x,
                          long count, long room) noexcept
    double row_of_doubles(const double* value, const int* place, const double* x,
                          long count, long room) noexcept
