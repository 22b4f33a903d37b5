// Nothing but the headers that CMakeLists.txt names, compiled for all tests.
int main() {}
