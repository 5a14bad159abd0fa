# libjpeg makes the pictures of a camera; tests that need it are left out where it is absent.
find_package(JPEG)
if(JPEG_FOUND)
  target_link_libraries(test_apps_daemon PRIVATE JPEG::JPEG)
  target_compile_definitions(test_apps_daemon PRIVATE FOVEA_HAVE_LIBJPEG)
endif()
