# Targets: tmcmc::tmcmc, pbox::pbox, friction::friction.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(OpenMP COMPONENTS CXX)
include(${CMAKE_CURRENT_LIST_DIR}/tmcmc_companion-targets.cmake)
