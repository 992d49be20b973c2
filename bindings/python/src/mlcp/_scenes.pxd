"""What the extension uses of the C++ scenes of examples/scenes."""
from libcpp.memory cimport unique_ptr
from libcpp.string cimport string
from libcpp.vector cimport vector

from mlcp._abi cimport mlcp_mask, mlcp_problem, mlcp_report, mlcp_settings, mlcp_solver

cdef extern from "scenes/scenes.h" namespace "scenes" nogil:
    cdef cppclass Point "scenes::Point":
        double &operator[](size_t)
    cdef enum class Role "scenes::Drawing::Role":
        pass
    cdef cppclass Ball "scenes::Drawing::Ball":
        Point centre
        double radius
        Role role
    cdef cppclass Face "scenes::Drawing::Face":
        vector[Point] corners
        Role role
    cdef cppclass Action "scenes::Drawing::Action":
        Point point
        Point direction
    cdef cppclass Corners "scenes::Drawing::Corners":
        Point &operator[](size_t)
    cdef cppclass Drawing:
        vector[Ball] spheres
        vector[Corners] boxes
        vector[vector[Point]] paths
        vector[Face] faces
        vector[Action] actions
        Point eye

    cdef cppclass Measure "scenes::Scene::Measure":
        const char *name
        double value

    cdef cppclass CppScene "scenes::Scene":
        void prepare(double) except +
        const mlcp_report &finish() except +
        const mlcp_problem *problem()
        const mlcp_mask *start()
        const mlcp_solver *solver()
        void use(const mlcp_settings &) except +
        void draw(Drawing &) except +
        vector[Measure] measures()

    cdef cppclass Film "scenes::Film":
        int steps
        int every
        int start "from"
    cdef cppclass Exhibit "scenes::Exhibit":
        const char *name
        const char *unit
        int default_size
        Film film
    cdef cppclass Gallery "std::span<const scenes::Exhibit>":
        size_t size()
        const Exhibit &operator[](size_t)
    Gallery gallery()
    cdef cppclass Choice "scenes::Choice":
        string name
        double value
    unique_ptr[CppScene] make_scene(const char *, int, unsigned, const vector[Choice] &) except +
