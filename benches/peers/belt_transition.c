/* The contact transitions of peer_belt_heyoka.py as a C extension: removes most of the Python cost of a heyoka callback.
   Lane record: V, mu_s, mu_d. Parameters: slip (1) or stick (0), sigma mu_d, and the event function p2 + p3 x + p4 v.
   Built by fast.py. One integrator per process (pointers are static). */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <math.h>
static double *S, *P, *L; static long B;
static const double OFF = 1e-13;
#define SS(i) S[(i)*B + l]
#define PP(i) P[(i)*B + l]
#define LL(i) L[(i)*B + l]
static void slip(long l, double sg) { PP(0) = 1; PP(1) = sg*LL(2); PP(2) = sg*LL(0); PP(3) = 0; PP(4) = -sg; }
static void stick(long l) { SS(1) = LL(0); PP(0) = 0; PP(1) = 0; PP(2) = LL(1); PP(3) = -1; PP(4) = 0; }
static void leave(long l, double sg) { SS(1) = LL(0) - sg*OFF; slip(l, sg); }
static void at_rest(long l) { if (fabs(SS(0)) < LL(1)) stick(l); else leave(l, SS(0) > 0 ? 1 : -1); }
/* from slip: v = V; from stick: x = mu_s, and slip to smaller v */
static PyObject *cb0(PyObject *self, PyObject *const *a, Py_ssize_t n) {
    long l = PyLong_AsLong(a[2]);
    if (PP(0) == 1) at_rest(l); else leave(l, 1);
    Py_RETURN_TRUE;
}
static PyObject *bind(PyObject *self, PyObject *args) {
    Py_ssize_t x, y, z;
    if (!PyArg_ParseTuple(args, "nnnl", &x, &y, &z, &B)) return NULL;
    S = (double *)x; P = (double *)y; L = (double *)z;
    for (long l = 0; l < B; l++) if (SS(1) == LL(0)) at_rest(l); else slip(l, SS(1) < LL(0) ? 1 : -1);
    Py_RETURN_NONE;
}
static PyMethodDef M[] = {{"cb0", (PyCFunction)(void (*)(void))cb0, METH_FASTCALL, 0}, {"bind", bind, METH_VARARGS, 0}, {0}};
static struct PyModuleDef D = {PyModuleDef_HEAD_INIT, "belt_transition", 0, -1, M};
PyMODINIT_FUNC PyInit_belt_transition(void) { return PyModule_Create(&D); }
