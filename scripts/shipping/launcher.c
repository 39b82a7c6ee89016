/* python.exe for a python3xx.dll that came without one. */
#include <wchar.h>

int Py_Main(int argc, wchar_t** argv);

int wmain(int argc, wchar_t** argv) { return Py_Main(argc, argv); }
