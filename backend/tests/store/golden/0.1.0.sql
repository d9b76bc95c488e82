BEGIN TRANSACTION;
CREATE TABLE accepted_finding (
	project_id INTEGER NOT NULL, 
	error VARCHAR(64) NOT NULL, 
	state VARCHAR(100) NOT NULL, 
	reason TEXT NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_accepted_finding PRIMARY KEY (project_id, error, state), 
	CONSTRAINT fk_accepted_finding_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
CREATE TABLE alembic_version (
	version_num VARCHAR(32) NOT NULL, 
	CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num)
);
INSERT INTO "alembic_version" VALUES('0008');
CREATE TABLE breakpoint (
	instance_id INTEGER NOT NULL, 
	number INTEGER NOT NULL, 
	content JSON NOT NULL, 
	CONSTRAINT pk_breakpoint PRIMARY KEY (instance_id, number), 
	CONSTRAINT fk_breakpoint_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE CASCADE
);
CREATE TABLE "error_history" (
	instance_id INTEGER NOT NULL, 
	error VARCHAR(64) NOT NULL, 
	program_version INTEGER NOT NULL, 
	status VARCHAR(16) NOT NULL, 
	code VARCHAR(16) NOT NULL, 
	details TEXT NOT NULL, 
	generated_at DATETIME NOT NULL, 
	recovered_at DATETIME, 
	generated_scan BIGINT NOT NULL, 
	recovered_scan BIGINT, 
	"by" VARCHAR(100) NOT NULL, 
	origin VARCHAR(16) NOT NULL, 
	count INTEGER NOT NULL, 
	reaction JSON, 
	reaction_state VARCHAR(16), 
	reaction_message TEXT DEFAULT '' NOT NULL, 
	CONSTRAINT pk_error_history PRIMARY KEY (instance_id, program_version, error), 
	CONSTRAINT fk_error_history_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE CASCADE
);
INSERT INTO "error_history" VALUES(1,'battery-error',7,'generated','00F7','','2026-11-21 12:00:00.000000',NULL,5,NULL,'ada','simulator',3,NULL,NULL,'');
CREATE TABLE file (
	project_id INTEGER NOT NULL, 
	path VARCHAR(255) NOT NULL, 
	text TEXT NOT NULL, 
	version INTEGER NOT NULL, 
	author VARCHAR(100) NOT NULL, 
	saved DATETIME NOT NULL, 
	CONSTRAINT pk_file PRIMARY KEY (project_id, path), 
	CONSTRAINT fk_file_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "file" VALUES(1,'main.st','PROGRAM Main END_PROGRAM',3,'ada','2026-11-21 12:00:00.000000');
CREATE TABLE instance (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	created DATETIME NOT NULL, powered BOOLEAN DEFAULT 1 NOT NULL, memory_mib INTEGER, cpu_percent INTEGER, run_mib INTEGER, 
	CONSTRAINT pk_instance PRIMARY KEY (id), 
	CONSTRAINT uq_instance_name UNIQUE (name), 
	CONSTRAINT fk_instance_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "instance" VALUES(1,1,'line 1','2026-11-21 12:00:00.000000',1,NULL,NULL,NULL);
CREATE TABLE log (
	id INTEGER NOT NULL, 
	instance_id INTEGER NOT NULL, 
	at DATETIME NOT NULL, 
	scan BIGINT NOT NULL, 
	author VARCHAR(100) NOT NULL, 
	kind VARCHAR(16) NOT NULL, 
	text TEXT NOT NULL, program_version INTEGER, 
	CONSTRAINT pk_log PRIMARY KEY (id), 
	CONSTRAINT fk_log_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE CASCADE
);
INSERT INTO "log" VALUES(1,1,'2026-11-21 12:00:00.000000',5,'ada','error','Battery error',7);
CREATE TABLE program_state (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	instance VARCHAR(100) NOT NULL, 
	scan BIGINT NOT NULL, 
	program_version INTEGER NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_program_state PRIMARY KEY (id), 
	CONSTRAINT uq_program_state_project_id_name UNIQUE (project_id, name), 
	CONSTRAINT fk_program_state_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
CREATE TABLE program_version (
	project_id INTEGER NOT NULL, 
	version INTEGER NOT NULL, 
	sources JSON NOT NULL, 
	hash VARCHAR(64) NOT NULL, 
	author VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_program_version PRIMARY KEY (project_id, version), 
	CONSTRAINT fk_program_version_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "program_version" VALUES(1,7,'{"main.st": "PROGRAM Main END_PROGRAM"}','0000000000000000000000000000000000000000000000000000000000000000','ada','2026-11-21 12:00:00.000000');
CREATE TABLE project (
	id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	model VARCHAR(64) NOT NULL, 
	watch JSON NOT NULL, 
	version INTEGER NOT NULL, 
	created DATETIME NOT NULL, 
	CONSTRAINT pk_project PRIMARY KEY (id), 
	CONSTRAINT uq_project_name UNIQUE (name)
);
INSERT INTO "project" VALUES(1,'conveyor','CJ1M-CPU63','["Main.n"]',7,'2026-11-21 12:00:00.000000');
CREATE TABLE sweep (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	instance_id INTEGER, 
	instance VARCHAR(100) NOT NULL, 
	model VARCHAR(64) NOT NULL, 
	program_version INTEGER NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	status VARCHAR(16) NOT NULL, 
	message TEXT NOT NULL, 
	window INTEGER NOT NULL, 
	states JSON NOT NULL, 
	errors JSON NOT NULL, 
	seconds DOUBLE NOT NULL, 
	CONSTRAINT pk_sweep PRIMARY KEY (id), 
	CONSTRAINT fk_sweep_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE SET NULL, 
	CONSTRAINT fk_sweep_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
CREATE TABLE sweep_cell (
	sweep_id INTEGER NOT NULL, 
	error VARCHAR(64) NOT NULL, 
	state VARCHAR(100) NOT NULL, 
	raised_scan BIGINT NOT NULL, 
	verdict VARCHAR(16), 
	first_read INTEGER, 
	first_effect INTEGER, 
	difference_count INTEGER NOT NULL, 
	note TEXT NOT NULL, 
	reaction JSON, 
	CONSTRAINT pk_sweep_cell PRIMARY KEY (sweep_id, error, state), 
	CONSTRAINT fk_sweep_cell_sweep_id FOREIGN KEY(sweep_id) REFERENCES sweep (id) ON DELETE CASCADE
);
CREATE TABLE test_record (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	title VARCHAR(255) NOT NULL, 
	text TEXT NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_test_record PRIMARY KEY (id), 
	CONSTRAINT fk_test_record_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
CREATE TABLE trace (
	instance_id INTEGER NOT NULL, 
	number INTEGER NOT NULL, 
	content JSON NOT NULL, 
	CONSTRAINT pk_trace PRIMARY KEY (instance_id, number), 
	CONSTRAINT fk_trace_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE CASCADE
);
CREATE TABLE trace_mapping (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	content JSON NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_trace_mapping PRIMARY KEY (id), 
	CONSTRAINT uq_trace_mapping_project_id_name UNIQUE (project_id, name), 
	CONSTRAINT fk_trace_mapping_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
CREATE TABLE trace_record (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	instance VARCHAR(100) NOT NULL, 
	content JSON NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_trace_record PRIMARY KEY (id), 
	CONSTRAINT fk_trace_record_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
CREATE TABLE verification_record (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	instance VARCHAR(100) NOT NULL, 
	content JSON NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_verification_record PRIMARY KEY (id), 
	CONSTRAINT fk_verification_record_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
CREATE TABLE watch_list (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	owner VARCHAR(100) NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	content JSON NOT NULL, 
	version INTEGER NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_watch_list PRIMARY KEY (id), 
	CONSTRAINT uq_watch_list_project_id_owner_name UNIQUE (project_id, owner, name), 
	CONSTRAINT fk_watch_list_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
CREATE INDEX ix_instance_project_id ON instance (project_id);
CREATE INDEX ix_log_instance_id_id ON log (instance_id, id);
CREATE INDEX ix_sweep_project_id ON sweep (project_id);
CREATE INDEX ix_test_record_project_id ON test_record (project_id);
CREATE INDEX ix_trace_record_project_id ON trace_record (project_id);
CREATE INDEX ix_verification_record_project_id ON verification_record (project_id);
COMMIT;
