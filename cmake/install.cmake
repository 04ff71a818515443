# cmake --install BUILD --prefix P: programs, what they print of themselves for shells and man, scenes, and the library
# with its headers and a package for find_package(fluidtex).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Programs. They find each other side by side.
install(TARGETS fluidtex fluidtex_reader fluidtex_sheet RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(CODE "set(program \"$<TARGET_FILE:fluidtex>\")
  set(share \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")")
install(SCRIPT cmake/install_printed.cmake)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/fluidtex
  FILES_MATCHING PATTERN *.toml PATTERN *.obj PATTERN *.png PATTERN *.ply PATTERN README.md)
# What Blender runs: the add-on, and what draws.
install(FILES tools/blender/fluidtex.py tools/blender/render.py tools/blender/solids.py tools/blender/stage.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fluidtex/blender)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The library: pipeline, and all rooms that it links.
add_library(library INTERFACE)
add_library(fluidtex::fluidtex ALIAS library)
set_target_properties(library PROPERTIES EXPORT_NAME fluidtex)
target_link_libraries(library INTERFACE pipeline)
fluidtex_linked(library rooms)
install(TARGETS ${rooms} EXPORT fluidtex ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/fluidtex)
foreach(room ${rooms})
  get_target_property(folder ${room} SOURCE_DIR)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
  if(folder)
    file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h)
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fluidtex/${folder})
  endif()
endforeach()
# A scene has the settings of all rooms.
install(FILES render/options.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fluidtex/render)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/fluidtex)
configure_package_config_file(cmake/fluidtexConfig.cmake.in ${PROJECT_BINARY_DIR}/fluidtexConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fluidtexConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT fluidtex NAMESPACE fluidtex:: FILE fluidtexTargets.cmake DESTINATION ${package})
install(FILES ${PROJECT_BINARY_DIR}/fluidtexConfig.cmake ${PROJECT_BINARY_DIR}/fluidtexConfigVersion.cmake
  cmake/installed_programs.cpp DESTINATION ${package})
