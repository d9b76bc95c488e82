"""The words of the printed report of a verification, in English and Japanese."""

from collections.abc import Mapping

from scanbench.reports.record_text import Language

WORDS: Mapping[Language, Mapping[str, str]] = {
    "en": {
        "title": "Verification report", "range": "Range", "scans": "Scans",
        "source": "Control device", "live": "the PLC, while it ran", "past": "the recorded run, run again natively",
        "trace": "controller log: {name}", "interval": "Task interval",
        "verdict": "Result", "no_difference": "No difference", "differences_found": "Differences found",
        "nothing_compared": "Nothing was compared",
        "compared": "Scans compared", "skipped": "Scans not compared", "differing": "Rows that differ",
        "skipped_text": "Not compared: {stretches}.", "all_compared": "All scans were compared.",
        "forgotten": "{count} rows are not in this report.",
        "differences": "Differences", "more_differences": "{count} more differences are not shown here; the JSON export has them.",
        "scan": "Scan", "call": "Call", "control": "A", "monitor": "A′",
        "control_long": "A, control device", "monitor_long": "A′, reference on the inputs used",
        "bits": "Bits that differ", "place": "Where", "task": "Task", "cause": "Cause", "disturbance": "Disturbance",
        "no_disturbance": "none on record",
        "logic": "logic: the same inputs gave a different result",
        "input": "input: what was read is not what should have been there: nobody wrote it, or somebody outside of the range",
        "order": "order: a different statement ran, or a different variable was used",
        "trap": "run-time error in one of them",
        "outside": "a variable that the range does not use",
        "recorded": "the run file has a different value than the same code gives when it runs again",
        "rows": "Rows that differ, and those around them", "rows_same": "The last rows",
        "inputs": "Inputs, in the order of use", "instance_path": "Instance",
        "columns_left_out": "{count} more columns are in the CSV and JSON exports.",
        "rows_left_out": "{count} more rows are in the CSV and JSON exports.",
        "expected": "expected {value}", "was_set": "set to {value}",
        "what": "A is what the control device came to. A′ is what the reference interpreter, which shares no code "
                "generation with it, came to from the same program and the same inputs.",
        "nothing": "–",
    },
    "ja": {
        "title": "検証報告書", "range": "検証範囲", "scans": "スキャン", "source": "制御装置", "live": "運転中のPLC", "past": "記録された運転（ネイティブ再実行）",
        "trace": "実機のトレース：{name}", "interval": "タスク周期",
        "verdict": "結果", "no_difference": "差異なし", "differences_found": "差異あり", "nothing_compared": "比較なし",
        "compared": "比較したスキャン", "skipped": "比較していないスキャン", "differing": "差異のある行",
        "skipped_text": "比較していないスキャン：{stretches}。", "all_compared": "すべてのスキャンを比較しました。",
        "forgotten": "{count}行はこの報告書に含まれていません。",
        "differences": "差異", "more_differences": "ほかに{count}件の差異があります（JSON出力に含まれます）。",
        "scan": "スキャン", "call": "呼出し", "control": "A", "monitor": "A′",
        "control_long": "A：制御装置", "monitor_long": "A′：使用された入力による基準実行",
        "bits": "異なるビット", "place": "箇所", "task": "タスク", "cause": "原因", "disturbance": "外乱",
        "no_disturbance": "記録なし",
        "logic": "論理：同じ入力から異なる結果",
        "input": "入力：読まれた値があるべき値と異なる（誰も書いていない、または範囲外で書かれた）",
        "order": "順序：異なる文を実行、または異なる変数を使用",
        "trap": "一方で実行時エラー",
        "outside": "検証範囲が使用しない変数",
        "recorded": "実行ファイルの値が、同じコードの再実行と異なる",
        "rows": "差異のある行とその前後", "rows_same": "最後の行",
        "inputs": "入力（使用順）", "instance_path": "インスタンス",
        "columns_left_out": "ほかに{count}列あります（CSV・JSON出力に含まれます）。",
        "rows_left_out": "ほかに{count}行あります（CSV・JSON出力に含まれます）。",
        "expected": "期待値 {value}", "was_set": "設定値 {value}",
        "what": "Aは制御装置の結果、A′は同じプログラムと同じ入力による基準インタプリタの結果です。"
                "両者はコード生成を共有しません。",
        "nothing": "–",
    },
}  # fmt: skip
