# cmake -DKEYS_FILE=.. -DIN=.. -DOUT=.. -P fill_in.cmake: a page with @KEYS@ replaced by what stands in a file. Not by
# configure_file, for which keys in brackets and @ have a meaning.
file(READ ${KEYS_FILE} keys)
file(READ ${IN} page)
string(FIND "${page}" "@KEYS@" at)
string(SUBSTRING "${page}" 0 ${at} front)
math(EXPR behind "${at} + 6")
string(SUBSTRING "${page}" ${behind} -1 back)
file(WRITE ${OUT} "${front}" "${keys}" "${back}")
