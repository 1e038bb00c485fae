# Completion of facetmill for fish. Stages are asked of facetmill itself.
complete -c facetmill -n __fish_use_subcommand -f -a "run plan pipe check info diff stages schema formats explain"
complete -c facetmill -n "__fish_seen_subcommand_from stages pipe" -a "(facetmill stages 2>/dev/null | string replace -r ' .*' '')"
complete -c facetmill -n "__fish_seen_subcommand_from schema" -f -a "pipeline report info diff"
complete -c facetmill -n "__fish_seen_subcommand_from run plan check" -a "quickstart scan-to-web lod-chain"
complete -c facetmill -n "__fish_seen_subcommand_from explain" -f -a "(facetmill explain 2>/dev/null | string replace -r ' .*' '')"
