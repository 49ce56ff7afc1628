# Targets: tmcmc::tmcmc, pbox::pbox, friction::friction.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(OpenMP COMPONENTS CXX)
include(${CMAKE_CURRENT_LIST_DIR}/tmcmc_companion-targets.cmake)

foreach(component IN LISTS tmcmc_companion_FIND_COMPONENTS)
  if(NOT TARGET ${component}::${component} AND tmcmc_companion_FIND_REQUIRED_${component})
    set(tmcmc_companion_FOUND FALSE)
    set(tmcmc_companion_NOT_FOUND_MESSAGE "no component '${component}': expected tmcmc, pbox or friction")
  endif()
endforeach()
