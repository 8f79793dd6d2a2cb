# Debian package of the Python package; to be run in the source tree: cpack --config report/python/deb.cmake
file(STRINGS "${CMAKE_CURRENT_LIST_DIR}/pyproject.toml" version REGEX "^version = ")
string(REGEX REPLACE "version = \"(.*)\"" "\\1" version "${version}")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME python3-crosscheck)
set(CPACK_PACKAGE_VERSION ${version})
set(CPACK_PACKAGE_CONTACT "Crosscheck maintainers <maintainers@users.noreply.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "mass-spring and cloth engines compared and checked, from Python")
set(CPACK_PACKAGE_DESCRIPTION "Calls the program crosscheck and hands its results over as NumPy arrays:
runs, comparisons, advice, checks of an engine written in NumPy, plots.")
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.9), python3-numpy, crosscheck")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-matplotlib)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-pandas, jupyter-notebook")
set(CPACK_PACKAGE_FILE_NAME python3-crosscheck)
# files that every Debian package must contain
set(papers "$ENV{PWD}/_CPack_Packages/papers")
file(MAKE_DIRECTORY "${papers}")
file(COPY_FILE "${CMAKE_CURRENT_LIST_DIR}/../../LICENSE" "${papers}/copyright")
file(WRITE "${papers}/changelog" "python3-crosscheck (${version}) unstable; urgency=low

  * See CHANGELOG.md of the source.

 -- ${CPACK_PACKAGE_CONTACT}  Thu, 01 Jan 1970 00:00:00 +0000
")
execute_process(COMMAND gzip -9nf "${papers}/changelog" COMMAND_ERROR_IS_FATAL ANY)
set(CPACK_INSTALLED_DIRECTORIES
  "${CMAKE_CURRENT_LIST_DIR}/crosscheck" usr/lib/python3/dist-packages/crosscheck
  "${papers}" usr/share/doc/python3-crosscheck)
set(CPACK_IGNORE_FILES "__pycache__")
set(CPACK_VERBATIM_VARIABLES ON)
