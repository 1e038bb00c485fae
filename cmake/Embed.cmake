# Ready pipelines become part of the executable: nothing is looked up at run time.
set(embedded_sources "")
