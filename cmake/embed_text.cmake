# cmake -DTEXT=<file> -DOUT=<file.cpp> -DHEADER=<header> -DNAME=<variable> -P embed_text.cmake: a source file that
# defines nurbeam::NAME, a std::string_view of the text.
file(READ ${TEXT} text)
if(text MATCHES "\\)embedded_text\"")
  message(FATAL_ERROR "${TEXT} holds the end of the raw string that it is to stand in")
endif()
file(WRITE ${OUT} "#include \"${HEADER}\"\n\nconst std::string_view nurbeam::${NAME} = R\"embedded_text(${text})embedded_text\";\n")
