# Runs PROGRAM ARGUMENT: it must succeed and print what matches EXPRESSION.
execute_process(COMMAND "${PROGRAM}" "${ARGUMENT}" RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE errors)
message("${text}${errors}")
if(NOT status EQUAL 0)
  message(FATAL_ERROR "it ended with status ${status}")
endif()
if(NOT text MATCHES "${EXPRESSION}")
  message(FATAL_ERROR "it does not say \"${EXPRESSION}\"")
endif()
