# Eigen and OpenMesh, with errors that name the packages to install. The sdist has both in third_party/.

set(bundled "${CMAKE_CURRENT_SOURCE_DIR}/third_party")
if(FAIRING_SYSTEM_LIBRARIES OR NOT EXISTS "${bundled}/eigen/Eigen/Core")
  find_package(Eigen3 3.4 QUIET NO_MODULE)
else()
  add_library(fairing_eigen INTERFACE)
  add_library(Eigen3::Eigen ALIAS fairing_eigen)
  target_include_directories(fairing_eigen SYSTEM INTERFACE "${bundled}/eigen")
endif()
if(NOT TARGET Eigen3::Eigen)
  message(FATAL_ERROR "Eigen 3.4 was not found. Debian and Ubuntu: apt-get install libeigen3-dev")
endif()

if(NOT FAIRING_OPENMESH_SOURCE AND NOT FAIRING_SYSTEM_LIBRARIES AND EXISTS "${bundled}/openmesh/src")
  set(FAIRING_OPENMESH_SOURCE "${bundled}/openmesh")
endif()
add_library(fairing_openmesh INTERFACE)
if(FAIRING_OPENMESH_SOURCE)
  set(openmesh_root "${FAIRING_OPENMESH_SOURCE}/src")
  if(NOT EXISTS "${openmesh_root}/OpenMesh/Core/Mesh/BaseKernel.hh")
    message(FATAL_ERROR "FAIRING_OPENMESH_SOURCE=${FAIRING_OPENMESH_SOURCE} holds no src/OpenMesh/Core; "
                        "point it at the top folder of OpenMesh's sources")
  endif()
  # The mesh kernel alone: no file formats, nor what they need; PropertyCreator.cc takes as long as all the rest.
  file(GLOB openmesh_sources "${openmesh_root}/OpenMesh/Core/Mesh/*.cc")
  list(APPEND openmesh_sources
    "${openmesh_root}/OpenMesh/Core/Utils/BaseProperty.cc"
    "${openmesh_root}/OpenMesh/Core/System/omstream.cc")
  add_library(openmesh_static STATIC ${openmesh_sources})
  target_include_directories(openmesh_static SYSTEM PUBLIC "${openmesh_root}")
  target_compile_definitions(openmesh_static PUBLIC OM_STATIC_BUILD)
  target_link_libraries(fairing_openmesh INTERFACE openmesh_static)
else()
  find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh)
  find_library(OPENMESH_CORE_LIBRARY OpenMeshCore)
  if(NOT OPENMESH_INCLUDE_DIR OR NOT OPENMESH_CORE_LIBRARY)
    message(FATAL_ERROR "OpenMesh was not found. Debian and Ubuntu: apt-get install libopenmesh-dev; "
                        "or give its sources: -DFAIRING_OPENMESH_SOURCE=/path/to/OpenMesh")
  endif()
  target_include_directories(fairing_openmesh SYSTEM INTERFACE "${OPENMESH_INCLUDE_DIR}")
  target_link_libraries(fairing_openmesh INTERFACE "${OPENMESH_CORE_LIBRARY}")
endif()
